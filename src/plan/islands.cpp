// Islands: union-find over the leaves of a plan.
#include "saltus/plan/islands.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "saltus/plan/detail/passes.hpp"

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

bool has_state_or_event(const PlanLeaf& leaf) {
  const Declarations& d = leaf.declared();
  return leaf.nx > 0 || leaf.nz > 0 || d.has_modes || !d.zero_crossings.empty() ||
         !d.edge_resets.empty() || !d.time_events.empty() || !d.histories.empty() ||
         !d.relations.empty();
}

class Finder {
 public:
  explicit Finder(const Plan& plan)
      : plan_(plan), n_(static_cast<int>(plan.leaves.size())), sets_(plan.leaves.size()) {
    find_live();
    find_active();
    find_copied();
    join_wires();
    join_queue();
    collect();
  }

  Islands take() { return std::move(found_); }

 private:
  const PlanLeaf& leaf(int i) const { return plan_.leaves[i]; }

  /// A leaf is live if it has a state or an event; a located boolean has events.
  void find_live() {
    read_.assign(plan_.nodes.size(), 0), live_.assign(plan_.leaves.size(), 0);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      read_[i] = plan_.node(i).used;
      if (plan_.node(i).located) live_[plan_.node(i).leaf] = 1;
    }
    for (const Tap& tap : plan_.taps) read_[tap.node] = 1;
    for (int i = 0; i < n_; ++i) {
      if (has_state_or_event(leaf(i))) live_[i] = 1;
      if (live_[i]) sets_.enliven(i);
    }
  }

  /// A leaf counts if it is live, if one of its outputs is read or recorded, or if it feeds an input
  /// of a leaf that counts.
  void find_active() {
    active_.assign(plan_.leaves.size(), 0);
    std::vector<int> open;
    const auto mark = [&](int i) {
      if (!std::exchange(active_[i], 1)) open.push_back(i);
    };
    for (int i = 0; i < n_; ++i)
      if (live_[i]) mark(i);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i)
      if (read_[i]) mark(plan_.node(i).leaf);
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int input : leaf(i).inputs) mark(plan_.node(input).leaf);
    }
  }

  /// A source is copied if neither it nor any block that it reads is live. A loop is not copied.
  void find_copied() {
    copied_.assign(plan_.leaves.size(), 0);
    List<int> state(plan_.leaves.size(), 0);  // 0: not seen, 1: under way, 2: known
    for (int first = 0; first < n_; ++first) {
      std::vector<int> open{first};
      while (!open.empty()) {
        const int i = open.back();
        if (state[i] == 2 || live_[i]) {
          state[i] = 2, open.pop_back();
          continue;
        }
        if (std::exchange(state[i], 1) == 0) {
          for (const int source : sources(i))
            if (state[source] == 0) open.push_back(source);
          continue;
        }
        state[i] = 2, open.pop_back();
        copied_[i] = std::ranges::all_of(sources(i), [&](int s) { return copied_[s] != 0; });
      }
    }
  }

  std::vector<int> sources(int i) const {
    std::vector<int> leaves;
    for (const int input : leaf(i).inputs) {
      if (plan_.node(input).leaf != i) leaves.push_back(plan_.node(input).leaf);
    }
    std::ranges::sort(leaves);
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    return leaves;
  }

  /// Joins the readers of few blocks first, so that the reader of many is named as the one that
  /// joins.
  void join_wires() {
    std::vector<std::pair<std::vector<int>, int>> readers;
    for (int i = 0; i < n_; ++i) {
      if (!active_[i] || copied_[i]) continue;
      std::vector<int> read = sources(i);
      std::erase_if(read, [&](int s) { return copied_[s] != 0; });
      if (!read.empty()) readers.emplace_back(std::move(read), i);
    }
    std::ranges::stable_sort(readers, {}, [](const auto& reader) { return reader.first.size(); });
    for (const auto& [read, i] : readers) join(read, i, name_of(i));
  }

  void join(const std::vector<int>& read, int i, std::string name) {
    std::vector<int> others;
    for (const int leaf : read)
      if (sets_.live(leaf) && sets_.find(leaf) != sets_.find(i)) others.push_back(sets_.find(leaf));
    std::ranges::sort(others);
    const auto parts =
        static_cast<std::size_t>(std::unique(others.begin(), others.end()) - others.begin());
    if (parts > 1 || (parts == 1 && sets_.live(i)))
      found_.joins.push_back({std::move(name), parts});
    for (const int leaf : read) sets_.join(leaf, i);
  }

  /// The first output of a block that is read or recorded, or the block.
  std::string name_of(int i) const {
    for (const int output : leaf(i).outputs)
      if (read_[output]) return plan_.name_of(plan_.node(output));
    return leaf(i).path;
  }

  /// All queued zero crossings share one queue, and one random order of ties.
  void join_queue() {
    std::vector<int> queued;
    for (int i = 0; i < n_; ++i) {
      if (std::ranges::any_of(leaf(i).declared().zero_crossings, &ZeroCrossing::is_queued))
        queued.push_back(i);
    }
    if (queued.size() < 2) return;
    join(queued, queued.front(), "the queue of executions");
  }

  void collect() {
    found_.of_leaf.assign(plan_.leaves.size(), -1);
    List<int> island(plan_.leaves.size(), -1);
    for (int i = 0; i < n_; ++i) {
      if (!active_[i] || copied_[i]) continue;
      place(i, island[sets_.find(i)]);
    }
    reader_.assign(plan_.leaves.size(), -1);
    for (std::size_t k = 0; k < found_.count(); ++k) add_copies(k);
    for (std::size_t i = 0; i < plan_.taps.size(); ++i) place_tapped(static_cast<int>(i));
    found_.taps.resize(found_.count());
    std::ranges::stable_sort(found_.joins, std::greater<>(), &Islands::Join::parts);
  }

  void place(int i, int& island) {
    if (island < 0) {
      island = static_cast<int>(found_.count());
      found_.leaves.emplace_back();
    }
    found_.of_leaf[i] = island;
    nth(found_.leaves, island).push_back(i);
  }

  /// Adds the sources that an island reads, and the sources of these.
  void add_copies(std::size_t k) {
    std::vector<int>& leaves = found_.leaves[k];
    std::vector<int> open = leaves;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int source : sources(i)) {
        if (!copied_[source]) continue;
        leaves.push_back(source), open.push_back(source);
      }
    }
    std::ranges::sort(leaves);
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    for (const int i : leaves)
      if (reader_[i] < 0) reader_[i] = static_cast<int>(k);
  }

  /// A recorded source has its rows in the first island that reads it, or is an island of its own.
  void place_tapped(int tap) {
    const int i = plan_.node(nth(plan_.taps, tap).node).leaf;
    int& island = found_.of_leaf[i];
    if (island < 0) island = reader_[i];
    if (island < 0) place(i, island), add_copies(found_.count() - 1);
    found_.taps.resize(found_.count());
    nth(found_.taps, island).push_back(tap);
  }

  const Plan& plan_;
  int n_;
  Sets sets_;
  List<char> read_;  // of each node: whether it is read or recorded
  List<char> live_, active_, copied_;
  List<int> reader_;  // the first island that has the leaf
  Islands found_;
};

/// The number in the part of a node of the whole. The leaves of the part are sorted.
int in_part(const Plan& whole, const Plan& part, const std::vector<int>& leaves, int number) {
  const Node& node = whole.node(number);
  const PlanLeaf& leaf = part.leaf(std::ranges::lower_bound(leaves, node.leaf) - leaves.begin());
  return node.relation ? leaf.relations[node.index] : leaf.outputs[node.index];
}

}  // namespace

Islands find_islands(const Plan& plan) { return Finder(plan).take(); }

std::string Islands::describe() const {
  constexpr std::size_t most = 8;
  std::string out = count() == 1 ? "islands: 1" : text("islands: ", count(), ", which step apart");
  // A chain of blocks is one part by its nature. It is the reason only where nothing else is.
  const bool chains = count() == 1 && !joins.empty() && joins.front().parts == 1;
  std::size_t n = 0;
  for (; n < joins.size() && n < most && (chains || joins[n].parts > 1); ++n) {
    out += n > 0 ? ", '" : count() == 1 ? ", because of '" : "; joined by '";
    out += text(joins[n].reader, "' (reads ", joins[n].parts,
                joins[n].parts == 1 ? " other part)" : " other parts)");
  }
  return out + (n == most && joins.size() > most ? ", ...\n" : "\n");
}

std::shared_ptr<const Plan> plan_of_island(const Plan& whole, const Islands& islands,
                                           std::size_t k) {
  const std::vector<int>& leaves = islands.leaves[k];
  Structure structure;
  Replacements declarations;
  for (const int i : leaves) {
    structure.leaves.push_back({whole.leaf(i).system, whole.leaf(i).path});
    declarations.push_back(whole.leaf(i).declarations);
  }
  Plan part;
  add_leaves(part, structure, declarations);
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    const List<int>& inputs = whole.leaf(leaves[l]).inputs;
    for (std::size_t input = 0; input < inputs.size(); ++input)
      part.leaves[l].inputs[input] = in_part(whole, part, leaves, inputs[input]);
  }
  add_needs(part);
  for (const int tap : islands.taps[k]) {
    const Tap& recorded = nth(whole.taps, tap);
    part.taps.push_back({recorded.name, in_part(whole, part, leaves, recorded.node)});
  }
  const Roots roots = find_shapes_and_rates(part);
  return completed(std::move(part), roots);
}

}  // namespace saltus
