// Expressions: values of a plan as nodes of one graph.
#pragma once

#include <span>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"
#include "saltus/tape/symbol.hpp"

namespace saltus::detail {

/// Holds values as nodes of one graph: the values of formulas that were added, and variables for
/// values computed elsewhere. The variables have the places that a function over the whole machine
/// reads (see Arguments): x, p, the signals y as its discrete state, all of z as input 0, and the
/// modes of the leaves, as numbers, as input 1.
class Expressions {
 public:
  static constexpr int variable = -1, input_of_z = 0, input_of_modes = 1;

  /// `first`: for each node of the plan its first entry among the values, or `variable`.
  Expressions(const Plan& plan, List<int>& first) : plan_(plan), first_(first) {}

  /// Adds the output `i`, which has a formula, as expressions of the values that it reads.
  void compute(int i) {
    const Node& node = plan_.node(i);
    const auto first = static_cast<int>(values_.size());
    add(plan_.output_of(node).formula, node.leaf, node.place.size);
    first_[i] = first;
  }
  /// The entries of an output that was computed.
  std::span<const tape::Node> of_node(int i) const {
    const tape::Node* first = values_.data() + first_[i];
    return {first, first + plan_.node(i).place.size};
  }
  /// Adds the entries of a formula of a leaf. The result is a view that lasts until the next call.
  std::span<const tape::Node> add(const Formula& formula, int leaf, Index size) {
    const std::size_t first = values_.size();
    OfLeaf symbols(*this, plan_.leaf(leaf));
    for (const tape::Symbol& entry : formula.symbols(symbols, size))
      values_.push_back(entry.in(graph_));
    return std::span(values_).subspan(first);
  }

  const tape::Graph& graph() const noexcept { return graph_; }
  tape::Graph& graph() noexcept { return graph_; }

 private:
  /// The symbols of one leaf.
  class OfLeaf final : public Symbols {
   public:
    OfLeaf(Expressions& all, const PlanLeaf& leaf) : all_(all), leaf_(leaf) {}
    tape::Symbol time() override { return symbol(graph().time()); }
    tape::Symbol state(Index i) override { return symbol(graph().continuous_state(leaf_.x + i)); }
    tape::Symbol discrete_state(Index i) override {
      return symbol(graph().input(input_of_z, leaf_.z + i));
    }
    tape::Symbol mode() override {
      return symbol(graph().input(input_of_modes, &leaf_ - all_.plan_.leaves.data()));
    }
    tape::Symbol parameter(Index i) override { return symbol(graph().parameter(leaf_.p + i)); }
    tape::Symbol input(int k, Index i) override { return value(leaf_.inputs, k, i); }
    Index width(int k) override { return leaf_.input_places[k].size; }
    Index columns(int k) override { return leaf_.input_places[k].columns; }
    tape::Symbol relation(RelationIndex r, Index i) override {
      return value(leaf_.relations, r.value, i);
    }

   private:
    tape::Graph& graph() { return all_.graph_; }
    tape::Symbol symbol(tape::Node node) { return {graph(), node}; }
    tape::Symbol value(const std::vector<int>& nodes, int k, Index i) {
      return symbol(all_.value(nodes[k], i));
    }
    Expressions& all_;
    const PlanLeaf& leaf_;
  };

  tape::Node value(int node, Index i) {
    const int first = first_[node];
    if (first != variable) return values_[first + i];
    const Place& place = plan_.node(node).place;
    switch (place.space) {
      case Space::x:
        return graph_.continuous_state(place.offset + i);
      case Space::p:
        return graph_.parameter(place.offset + i);
      case Space::z:
        return graph_.input(input_of_z, place.offset + i);
      default:
        return graph_.discrete_state(place.offset + i);
    }
  }

  const Plan& plan_;
  List<int>& first_;
  tape::Graph graph_;
  std::vector<tape::Node> values_;
};

}  // namespace saltus::detail
