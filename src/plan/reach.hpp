// The states that each entry of each signal read by a derivative depends on.
#pragma once

#include <numeric>

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/flatten.hpp"
#include "saltus/plan/detail/sparsity.hpp"

namespace saltus::detail {

/// Sets of states, by number: 0 is the empty set, 1 + i is state i alone, the others are listed. A
/// set that many entries share is stored once.
class StateSets {
 public:
  explicit StateSets(Index n) : n_(n), limit_(most_places(n)) {}

  static int single(Index i) { return static_cast<int>(i) + 1; }

  /// Calls f(state) for each member, in order.
  template <class F>
  void each(int set, F f) const {
    if (set == 0) return;
    if (set <= n_) return f(set - 1);
    for (const int i : listed(set)) f(i);
  }

  /// The union of sets; a set may be named more than once.
  int unite(std::vector<int>& sets) {
    std::ranges::sort(sets);
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    if (!sets.empty() && sets.front() == 0) sets.erase(sets.begin());
    if (sets.empty()) return 0;
    if (sets.size() == 1) return sets.front();
    std::vector<int> all;
    for (const int set : sets) each(set, [&](int i) { all.push_back(i); });
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    kept_ += static_cast<Index>(all.size());
    lists_.push_back(std::move(all));
    return static_cast<int>(n_ + static_cast<Index>(lists_.size()));
  }

  bool overflow() const { return kept_ > limit_; }

 private:
  const std::vector<int>& listed(int set) const { return lists_[set - 1 - n_]; }

  Index n_, limit_, kept_ = 0;
  List<std::vector<int>> lists_;
};

/// The states that each entry of each signal read by a derivative depends on.
class Reach {
 public:
  explicit Reach(const Plan& plan) : plan_(plan), sets_(plan.nx), of_node_(plan.nodes.size()) {
    for (const int i : plan.needs.derivatives) {
      if (sets_.overflow()) return;
      visit(i);
    }
  }

  /// The set of states for entry i of a leaf's value that reads these inputs and relations of the
  /// leaf.
  template <class Of>
  void behind(const PlanLeaf& leaf, const std::vector<int>& inputs, const EntryRule& rule, Index n,
              Of put) {
    List<Index> widths;
    for (const int node : leaf.inputs) widths.push_back(plan_.node(node).shape.size);
    std::vector<int> found;
    const auto gather = [&](Index i) {
      found.clear();
      for (const int k : inputs) {
        const int node = leaf.inputs[k];
        const EntryRange range = rule ? rule(i, k, widths) : EntryRange{0, widths[k]};
        const Index last = std::min(range.last, widths[k]);
        for (Index e = range.first; e < last; ++e) found.push_back(set_of(node, e));
      }
      return sets_.unite(found);
    };
    const int common = rule ? 0 : gather(0);
    for (Index i = 0; i < n; ++i) put(i, rule ? gather(i) : common);
  }

  StateSets& sets() { return sets_; }

 private:
  int set_of(int node, Index entry) const {
    const Node& of = plan_.node(node);
    if (of.rate != Rate::continuous) return 0;
    if (of.view) return of.place.space == Space::x ? StateSets::single(of.place.offset + entry) : 0;
    const auto& sets = of_node_[node];
    return sets.empty() ? 0 : sets[entry];
  }

  void visit(int number) {
    const Node& node = plan_.node(number);
    if (node.relation) return;  // held if it reaches a derivative
    const PlanLeaf& leaf = plan_.leaf_of(node);
    const OutputDeclaration& output = plan_.output_of(node);
    std::vector<int> own;
    if (has(output.reads, Reads::continuous_state)) {
      for (Index i = 0; i < leaf.nx; ++i) own.push_back(StateSets::single(leaf.x + i));
    }
    const int state = sets_.unite(own);
    auto& sets = of_node_[number];
    sets.resize(node.shape.size);
    const auto inputs = inputs_of(leaf, output.reads, output.inputs);
    behind(leaf, inputs, output.entries, node.shape.size, [&](Index i, int set) {
      std::vector<int> both{state, set};
      sets[i] = state == 0 ? set : sets_.unite(both);
    });
  }

 public:
  /// The numbers of the inputs that are read.
  static std::vector<int> inputs_of(const PlanLeaf& leaf, Reads reads,
                                    const std::optional<std::vector<int>>& named) {
    if (!has(reads, Reads::inputs)) return {};
    if (named) return *named;
    std::vector<int> all(leaf.inputs.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

 private:
  const Plan& plan_;
  StateSets sets_;
  List<List<int>> of_node_;
};

}  // namespace saltus::detail
