// Fixed inputs: values that were given to inputs in place of a wire.
#pragma once

#include <memory>
#include <optional>
#include <ranges>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "saltus/base/model_errors.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// Finds the number of a system's leaf in a plan.
class LeafNumbers {
 public:
  explicit LeafNumbers(const Plan& plan) {
    numbers_.reserve(plan.leaves.size());
    for (std::size_t i = 0; i < plan.leaves.size(); ++i) numbers_.emplace(plan.leaves[i].system, i);
  }
  std::optional<std::size_t> find(const LeafSystem* system) const {
    const auto found = numbers_.find(system);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::unordered_map<const LeafSystem*, std::size_t> numbers_;
};

/// Makes a fixed value an output of the block whose input it feeds, in the plan only. It is
/// constant, and comes after the own outputs of the block.
inline void add_fixed(Plan& plan, const Structure::FixedInput& fixed, std::size_t number) {
  PlanLeaf& leaf = plan.leaves[number];
  auto declared = std::make_shared<Declarations>(leaf.declared());
  declared->outputs.push_back(
      {.name = declared->inputs[fixed.to.index].name,
       .calc = [value = fixed.value](const At&, VectorRef out) { out = value; },
       .shape = fixed.shape,
       .reads = Reads::parameters});
  const int node = static_cast<int>(plan.nodes.size());
  plan.nodes.push_back(
      {.leaf = static_cast<int>(number), .index = static_cast<int>(declared->outputs.size()) - 1});
  leaf.inputs[fixed.to.index] = node;
  leaf.outputs.push_back(node);
  leaf.declarations = std::move(declared);
}

/// Whether a node is a fixed value.
inline bool is_fixed(const Plan& plan, const Node& node) {
  const auto own = std::ssize(plan.leaf_of(node).system->declarations().outputs);
  return !node.relation && node.index >= own;
}

/// The value of the outermost system counts where several fix one input.
inline void add_fixed_inputs(Plan& plan, const Structure& structure, const LeafNumbers& numbers) {
  std::unordered_set<int> added;
  for (const Structure::FixedInput& fixed : structure.fixed | std::views::reverse) {
    const std::size_t number = numbers.find(fixed.to.leaf).value();
    const PlanLeaf& leaf = plan.leaves[number];
    const int source = leaf.inputs[fixed.to.index];
    if (source < 0) {
      added.insert(static_cast<int>(plan.nodes.size()));
      add_fixed(plan, fixed, number);
    } else if (!added.contains(source)) {
      throw BuilderError(text("input '", leaf.declared().inputs[fixed.to.index].name,
                              "' of block '", leaf.path, "' has two sources: output '",
                              plan.name_of(plan.node(source)),
                              "' and its fixed value; an input takes one"));
    }
  }
}

}  // namespace saltus::detail
