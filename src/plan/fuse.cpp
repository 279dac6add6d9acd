#include "saltus/plan/detail/fuse.hpp"
#include "saltus/base/list.hpp"

#include <utility>

#include "expressions.hpp"
#include "fusible.hpp"
#include "saltus/plan/detail/needs.hpp"
#include "saltus/tape/tape.hpp"

namespace saltus::detail {

namespace {

/// A consumer at the end of a list: an ode or a group of guards.
struct Sink {
  int leaf = -1;
  const Formula* formula = nullptr;  // null: the sink stays a call
  Index to = 0, size = 0;            // in xdot, or in the vector of guards
  std::vector<int> needs = {};
  std::vector<int> stored = {};  // nodes that are looked at with it
};

/// The values of a stage and their places. `first` has an entry for each node; the writers of all
/// stages share it.
class WalkWriter {
 public:
  WalkWriter(const Plan& plan, List<int>& first)
      : plan_(plan), first_(first), values_(plan, first) {}

  void compute(int i) { values_.compute(i); }
  /// Stores a computed value to its own place.
  void keep(int i) { put(values_.of_node(i), plan_.node(i).place); }
  void put(const Sink& sink) {
    put(values_.add(*sink.formula, sink.leaf, sink.size), {Space::y, sink.to, sink.size});
  }
  /// The next stage reads these values as variables.
  void forget(const std::vector<int>& nodes) {
    for (const int i : nodes) first_[i] = Expressions::variable;
  }

  VectorFunction function() const {
    if (outputs_.empty()) return {};
    return tape::as_vector_function(tape::Tape(values_.graph(), outputs_, places_));
  }

 private:
  void put(std::span<const tape::Node> values, const Place& to) {
    for (Index i = 0; i < to.size; ++i) {
      outputs_.push_back(nth(values, i));
      places_.push_back(to.offset + i);
    }
  }

  const Plan& plan_;
  List<int>& first_;
  Expressions values_;
  std::vector<tape::Node> outputs_;
  std::vector<Index> places_;
};

/// A list with its sinks, cut into stages. A stage is one fused function, then the calls of that
/// stage. A call goes to the first stage where it can be; a formula goes to the last one, so a
/// formula that only sinks read becomes part of the last function, which stores none of its values.
class Stages {
 public:
  Stages(const Plan& plan, const std::vector<int>& list, const std::vector<Sink>& sinks)
      : plan_(plan), list_(list), sinks_(sinks), stage_(plan.nodes.size(), absent) {
    for (const int i : list_) stage(i) = first_stage(i);
    for (const int i : list_) stages_ = std::max(stages_, stage(i) + 1);
    for (const int i : list_) {
      if (fuses(i)) stage(i) = stages_;
    }
    for (const Sink& sink : sinks_) {
      if (sink.formula == nullptr) settle(sink.needs, stages_ - 1);
      settle(sink.stored, stages_ - 1);
    }
    for (auto i = list_.rbegin(); i != list_.rend(); ++i) settle(plan_.node(*i).needs, stage(*i));
  }

  Walk walk() const {
    Walk walk;
    walk.stages.resize(stages_);
    List<std::vector<int>> formulas(stages_ + 1);
    for (const int i : list_) {
      const int s = stage(i);
      (fuses(i) ? formulas[s] : walk.stages[s].calls).push_back(i);
    }
    const auto kept = find_kept();
    List<int> first(plan_.nodes.size(), Expressions::variable);
    for (std::size_t s = 0; s < walk.stages.size(); ++s) {
      WalkWriter writer(plan_, first);
      write(writer, formulas[s], kept);
      walk.stages[s].fused = writer.function();
      writer.forget(formulas[s]);
    }
    WalkWriter last(plan_, first);
    write(last, formulas.back(), kept);
    for (const Sink& sink : sinks_) {
      walk.fused.push_back(sink.formula != nullptr);
      if (sink.formula != nullptr) last.put(sink);
    }
    walk.last = last.function();
    for (const auto& nodes : formulas) append(walk.nodes, nodes);
    return walk;
  }

 private:
  static constexpr int absent = -1;

  bool fuses(int i) const {
    const Node& node = plan_.node(i);
    return !node.relation && fusible(plan_.output_of(node).formula, node.place.size) != nullptr;
  }
  int& stage(int i) { return stage_[i]; }
  int stage(int i) const { return stage_[i]; }

  /// A formula follows the calls it reads, so its stage follows theirs.
  int first_stage(int i) const {
    int first = 0;
    for (const int need : plan_.node(i).needs) {
      if (stage(need) != absent)
        first = std::max(first, stage(need) + (fuses(i) && !fuses(need) ? 1 : 0));
    }
    return first;
  }
  /// Makes sure that the formulas which a stage reads are in this stage or in an earlier one.
  void settle(const std::vector<int>& needs, int reader) {
    for (const int need : needs) {
      if (stage(need) != absent && fuses(need)) stage(need) = std::min(stage(need), reader);
    }
  }

  static void write(WalkWriter& writer, const std::vector<int>& nodes, const List<char>& kept) {
    for (const int i : nodes) {
      writer.compute(i);
      if (kept[i]) writer.keep(i);
    }
  }

  /// The values that must be stored, because another function reads them.
  List<char> find_kept() const {
    List<char> kept(plan_.nodes.size());
    const auto keep = [&](const std::vector<int>& needs, int reader) {
      for (const int need : needs)
        if (stage(need) != reader) kept[need] = 1;
    };
    for (const int i : list_) keep(plan_.node(i).needs, fuses(i) ? stage(i) : absent);
    for (const Sink& sink : sinks_) {
      keep(sink.needs, sink.formula != nullptr ? stages_ : absent);
      for (const int i : sink.stored) kept[i] = 1;
    }
    return kept;
  }

  const Plan& plan_;
  const std::vector<int>& list_;
  const std::vector<Sink>& sinks_;
  List<int> stage_;
  int stages_ = 0;
};

std::vector<Sink> odes_of(const Plan& plan) {
  static const Formula still([](const auto&) { return 0.0; });
  std::vector<Sink> sinks;
  for (const int i : plan.odes) {
    const PlanLeaf& leaf = plan.leaves[i];
    const ContinuousState& state = leaf.declared().continuous;
    Sink sink{i, fusible(state.ode ? state.formula : still, leaf.nx), leaf.x, leaf.nx};
    if (state.ode && has(state.reads, Reads::inputs)) sink.needs = read_inputs(state.inputs, leaf);
    if (state.ode && has(state.reads, Reads::relations)) append(sink.needs, leaf.relations);
    sinks.push_back(std::move(sink));
  }
  return sinks;
}

/// A guard that is not always seen stays a call, so it is evaluated only if it can fire.
std::vector<Sink> guards_of(const Plan& plan) {
  std::vector<Sink> sinks;
  for (const GuardGroup& group : plan.guards) {
    const PlanLeaf& leaf = plan.leaves[group.leaf];
    Sink sink{group.leaf, nullptr, group.slot, group.size};
    if (group.kind == GuardGroup::Kind::crossing) {
      const auto& crossing = leaf.declared().zero_crossings[group.index];
      if (!crossing.start_mode && group.controls.empty())
        sink.formula = fusible(crossing.formula, group.size);
      sink.needs = read_inputs(crossing.inputs, leaf);
      append(sink.needs, leaf.relations);
    } else {
      const Node& node = plan.node(group.index);
      if (node.relation) sink.formula = fusible(plan.relation_of(node).formula, group.size);
      sink.needs = node.needs;
    }
    for (const ReadSlot& read : group.reads) sink.stored.push_back(read.node);
    sinks.push_back(std::move(sink));
  }
  return sinks;
}

Walk walk_of(const Plan& plan, const std::vector<int>& list, const std::vector<Sink>& sinks) {
  Walk walk = Stages(plan, list, sinks).walk();
  return walk.fuses() ? walk : Walk{};
}

}  // namespace

void fuse(Plan& plan) {
  plan.walks.derivatives = walk_of(plan, plan.needs.derivatives, odes_of(plan));
  plan.walks.guards = walk_of(plan, plan.needs.guards, guards_of(plan));
}

}  // namespace saltus::detail
