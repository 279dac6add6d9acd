// Islands: union-find over the leaves of a plan.
#include "saltus/plan/islands.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

#include "island_blocks.hpp"
#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/diagram_parameters.hpp"
#include "saltus/plan/detail/needs.hpp"

namespace saltus {

namespace {

using namespace detail;

/// Sets of leaves. A set is live if a block in it has a state or an event.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n, 0), live_(n, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void enliven(int leaf) { live_[find(leaf)] = 1; }
  bool live(int leaf) { return live_[find(leaf)] != 0; }
  int find(int leaf) {
    while (parent_[leaf] != leaf) leaf = parent_[leaf] = parent_[parent_[leaf]];
    return leaf;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    live_[std::min(a, b)] |= live_[std::max(a, b)];
  }

 private:
  List<int> parent_;
  List<char> live_;
};

class Finder {
 public:
  Finder(const Plan& plan, DelayedWires delayed)
      : plan_(plan),
        n_(static_cast<int>(plan.leaves.size())),
        blocks_(plan),
        sets_(plan.leaves.size()),
        computed_of_(computed_by_leaf(plan)) {
    for (int i = 0; i < n_; ++i)
      if (blocks_.live[i]) sets_.enliven(i);
    join_wires();
    join_queue();
    join_outside();
    join_event_wires(delayed);
    collect();
    collect_event_wires();
    collect_computed();
  }

  Islands take() { return std::move(found_); }

 private:
  const PlanLeaf& leaf(int i) const { return plan_.leaves[i]; }

  /// Joins the readers of few blocks first, so that the reader of many is named as the one that
  /// joins.
  void join_wires() {
    std::vector<std::pair<std::vector<int>, int>> readers;
    for (int i = 0; i < n_; ++i) {
      if (!blocks_.active[i] || blocks_.copied[i]) continue;
      std::vector<int> read = sources_of(plan_, i);
      std::erase_if(read, [&](int s) { return blocks_.copied[s] != 0; });
      if (!read.empty()) readers.emplace_back(std::move(read), i);
    }
    std::ranges::stable_sort(readers, {}, [](const auto& reader) { return reader.first.size(); });
    for (const auto& [read, i] : readers) join(read, i, name_of(i));
  }

  void join(const std::vector<int>& read, int i, std::string name, bool by_events = false) {
    std::vector<int> others;
    for (const int leaf : read)
      if (sets_.live(leaf) && sets_.find(leaf) != sets_.find(i)) others.push_back(sets_.find(leaf));
    std::ranges::sort(others);
    const auto parts =
        static_cast<std::size_t>(std::unique(others.begin(), others.end()) - others.begin());
    if (parts > 1 || (parts == 1 && sets_.live(i)))
      found_.joins.push_back({std::move(name), by_events, parts});
    for (const int leaf : read) sets_.join(leaf, i);
  }

  /// The first output of a block that is read or recorded, or the block.
  std::string name_of(int i) const {
    for (const int output : leaf(i).outputs)
      if (blocks_.read[output]) return plan_.name_of(plan_.node(output));
    return leaf(i).path;
  }

  /// All queued zero crossings share one queue, and one random order of ties.
  void join_queue() {
    join_all("the queue of executions", [](const Declarations& declared) {
      return std::ranges::any_of(declared.zero_crossings, &ZeroCrossing::is_queued);
    });
  }

  /// A value outside of the system has one present value.
  void join_outside() {
    join_all("values that callbacks write outside of the states", &Declarations::shares_outside);
  }

  template <class Which>
  void join_all(const char* name, Which which) {
    std::vector<int> all;
    for (int i = 0; i < n_; ++i)
      if (std::invoke(which, leaf(i).declared())) all.push_back(i);
    if (all.size() > 1) join(all, all.front(), name);
  }

  /// Wires without a delay always join: an instant is one for all blocks that it reaches.
  void join_event_wires(DelayedWires delayed) {
    std::map<std::pair<int, int>, std::vector<int>> sources;  // of each event input
    for (const EventWire& wire : plan_.event_wires.declared)
      if (wire.delay == 0.0 || delayed == DelayedWires::join)
        sources[{wire.to, wire.input}].push_back(wire.from);
    for (const auto& [to, from] : sources) {
      const PlanLeaf& of = leaf(to.first);
      join(from, to.first, text(of.path, ".", of.declared().event_inputs[to.second].name), true);
    }
  }

  void collect_event_wires() {
    const auto& wires = plan_.event_wires.declared;
    if (!wires.empty()) found_.event_wires.resize(found_.count());
    for (std::size_t i = 0; i < wires.size(); ++i) {
      const int from = found_.of_leaf[wires[i].from];
      const bool inside = from == found_.of_leaf[wires[i].to];
      auto& all = inside ? found_.event_wires : found_.outgoing;
      if (!inside) all.resize(found_.count());
      nth(all, from).push_back(static_cast<int>(i));
    }
  }

  /// The diagrams compute in the order of the whole plan, the outer ones first.
  void collect_computed() {
    found_.diagrams.assign(found_.count(), 0);
    if (!plan_.computed) return;
    found_.computed.resize(found_.count());
    for (std::size_t k = 0; k < found_.count(); ++k) {
      for (const int i : found_.leaves[k]) {
        detail::append(found_.computed[k], computed_of_[i]);
        if (is_diagram(i)) ++found_.diagrams[k];
      }
      std::ranges::sort(found_.computed[k]);
    }
  }

  bool is_diagram(int i) const {
    return dynamic_cast<const DiagramParameters*>(leaf(i).system) != nullptr;
  }

  void collect() {
    found_.of_leaf.assign(plan_.leaves.size(), -1);
    List<int> island(plan_.leaves.size(), -1);
    for (int i = 0; i < n_; ++i) {
      if (!blocks_.active[i] || blocks_.copied[i]) continue;
      place(i, island[sets_.find(i)]);
    }
    reader_.assign(plan_.leaves.size(), -1);
    for (std::size_t k = 0; k < found_.count(); ++k) add_copies(k);
    for (int i = 0; i < n_; ++i)
      if (blocks_.live[i] && blocks_.copied[i]) place_copied(i);
    for (std::size_t i = 0; i < plan_.taps.size(); ++i) place_tapped(static_cast<int>(i));
    found_.taps.resize(found_.count());
    std::ranges::stable_sort(found_.joins, std::greater<>(), &Islands::Join::parts);
  }

  void place(int i, int& island) {
    if (island < 0) {
      island = static_cast<int>(found_.count());
      found_.leaves.emplace_back(), found_.first.push_back(i);
    }
    found_.of_leaf[i] = island;
    nth(found_.leaves, island).push_back(i);
  }

  /// Adds the sources that an island reads, the diagrams that compute parameters of its blocks, and
  /// the same of these.
  void add_copies(std::size_t k) {
    std::vector<int>& leaves = found_.leaves[k];
    std::vector<int> open = leaves;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int source : sources_of(plan_, i)) {
        if (!blocks_.copied[source]) continue;
        leaves.push_back(source), open.push_back(source);
      }
      for (const int number : computed_of_[i]) {
        const int diagram = leaf_of_parameter(plan_, plan_.computed->all[number].from);
        leaves.push_back(diagram), open.push_back(diagram);
      }
    }
    std::ranges::sort(leaves);
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    for (const int i : leaves)
      if (reader_[i] < 0) reader_[i] = static_cast<int>(k);
  }

  /// A source with copies belongs to the first island that reads it, or is an island of its own.
  int place_copied(int i) {
    int& island = found_.of_leaf[i];
    if (island < 0) island = reader_[i];
    if (island < 0) place(i, island), add_copies(found_.count() - 1);
    return island;
  }

  void place_tapped(int tap) {
    const int island = place_copied(plan_.node(nth(plan_.taps, tap).node).leaf);
    found_.taps.resize(found_.count());
    nth(found_.taps, island).push_back(tap);
  }

  const Plan& plan_;
  int n_;
  IslandBlocks blocks_;
  Sets sets_;
  List<std::vector<int>> computed_of_;  // of each leaf: the parameters that diagrams compute for it
  List<int> reader_;                    // the first island that has the leaf
  Islands found_;
};

}  // namespace

Islands find_islands(const Plan& plan, DelayedWires delayed) {
  return Finder(plan, delayed).take();
}

namespace {

constexpr std::size_t most_shown = 8;

/// The joins that are shown. A chain of blocks is one part by its nature: it is the reason only
/// where nothing else is. An event wire joins what would otherwise step apart.
std::vector<const Islands::Join*> shown_joins(const Islands& islands) {
  const auto& joins = islands.joins;
  const bool chains = islands.count() == 1 && !joins.empty() && joins.front().parts == 1;
  std::vector<const Islands::Join*> shown;
  for (const Islands::Join& join : joins)
    if (chains || join.parts > 1 || join.by_events) shown.push_back(&join);
  return shown;
}

std::string text_of(const Islands::Join& join) {
  return text(join.reader, join.by_events ? "' (gets events of " : "' (reads ", join.parts,
              join.parts == 1 ? " other part)" : " other parts)");
}

}  // namespace

std::string Islands::describe() const {
  std::string out = count() == 1 ? "islands: 1" : text("islands: ", count(), ", which step apart");
  const auto shown = shown_joins(*this);
  for (std::size_t i = 0; i < std::min(shown.size(), most_shown); ++i) {
    out += i > 0 ? ", '" : count() == 1 ? ", because of '" : "; joined by '";
    out += text_of(*shown[i]);
  }
  if (shown.size() > most_shown) out += ", ...";
  std::size_t between = 0;
  for (const auto& wires : outgoing) between += wires.size();
  if (between > 0) out += text("; ", between, " event wires with delays lead from one to another");
  return out + "\n";
}

}  // namespace saltus
