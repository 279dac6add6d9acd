#include "traces.hpp"

#include <algorithm>
#include <utility>

namespace saltus::python {

namespace {

std::size_t declared_by(const PythonLeaf& leaf) {
  const Declarations& d = leaf.declarations();
  return leaf.functions().size() + d.inputs.size() + d.outputs.size() + d.parameters.size() +
         static_cast<std::size_t>(d.continuous.initial.size() + d.discrete.size());
}

}  // namespace

void BlockTraces::take_shapes(const Plan& plan, const PlanLeaf& where) {
  inputs.clear(), outputs.clear();
  const Declarations& own = leaf->declarations();  // without control signals and fixed inputs
  for (int i = 0; i < count_of(own.inputs); ++i) inputs.push_back(plan.node(where.inputs[i]).shape);
  for (int i = 0; i < count_of(own.outputs); ++i)
    outputs.push_back(plan.node(where.outputs[i]).shape);
}

void BlockTraces::guess_shapes() {
  inputs.clear(), outputs.clear();
  for (const auto& input : leaf->declarations().inputs)
    inputs.push_back(input.shape.value_or(Shape::scalar()));
  for (const auto& output : leaf->declarations().outputs) {
    outputs.push_back(output.shape        ? *output.shape
                      : output.shape_rule ? output.shape_rule(inputs)
                                          : Shape::scalar());
  }
}

Traces::Traces(const System& system) {
  for (const auto& [block, path] : structure_of(system).leaves) {
    const auto* leaf = dynamic_cast<const PythonLeaf*>(block);
    if (leaf == nullptr) continue;
    numbers_.emplace(leaf, blocks_.size());
    blocks_.push_back({.leaf = leaf, .path = path, .declared = declared_by(*leaf)});
  }
}

bool Traces::stale() const {
  if (fixes_ != System::fixes()) return true;
  return std::ranges::any_of(
      blocks_, [](const BlockTraces& block) { return block.declared != declared_by(*block.leaf); });
}

bool Traces::complete() const { return std::ranges::all_of(blocks_, &BlockTraces::traced); }

void Traces::guess_shapes() {
  for (BlockTraces& block : blocks_) block.guess_shapes();
}

void Traces::set(std::size_t number, std::vector<Trace> traces) {
  BlockTraces& block = blocks_.at(number);
  block.traces = std::move(traces);
  block.traced = true;
}

void Traces::share(std::size_t number, std::vector<int> readers, std::vector<int> writers) {
  blocks_.at(number).shared = {std::move(readers), std::move(writers)};
}

std::optional<std::size_t> Traces::number_of(const LeafSystem& leaf) const {
  const auto found = numbers_.find(&leaf);
  return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace saltus::python
