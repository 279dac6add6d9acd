#include "survey.hpp"

#include "saltus/plan/compile.hpp"

namespace saltus::python {

namespace {

std::size_t declared_by(const PythonLeaf& leaf) {
  const Declarations& d = leaf.declarations();
  return leaf.functions().size() + d.inputs.size() + d.outputs.size() + d.parameters.size() +
         static_cast<std::size_t>(d.continuous.initial.size() + d.discrete.size());
}

std::vector<SurveyedBlock> python_blocks(const Structure& structure) {
  std::vector<SurveyedBlock> blocks;
  for (const auto& [system, path] : structure.leaves) {
    if (const auto* leaf = dynamic_cast<const PythonLeaf*>(system))
      blocks.push_back({leaf, path, {}, {}, declared_by(*leaf)});
  }
  return blocks;
}

void take_shapes(SurveyedBlock& block, const Plan& plan) {
  const PlanLeaf& leaf = *std::ranges::find(plan.leaves, block.leaf, &PlanLeaf::system);
  for (const int node : leaf.inputs) block.inputs.push_back(plan.node(node).shape);
  for (const int node : leaf.outputs) block.outputs.push_back(plan.node(node).shape);
}

void guess_shapes(SurveyedBlock& block) {
  for (const auto& input : block.leaf->declarations().inputs)
    block.inputs.push_back(input.shape.value_or(Shape::scalar()));
  for (const auto& output : block.leaf->declarations().outputs) {
    block.outputs.push_back(output.shape        ? *output.shape
                            : output.shape_rule ? output.shape_rule(block.inputs)
                                                : Shape::scalar());
  }
}

}  // namespace

bool Survey::stale() const {
  return std::ranges::any_of(blocks, [](const SurveyedBlock& block) {
    return block.declared != declared_by(*block.leaf);
  });
}

Survey survey_of(const System& system, bool incomplete) {
  Survey survey{&system, python_blocks(structure_of(system))};
  if (survey.blocks.empty()) return survey;
  try {
    const auto plan = compile(system);
    for (SurveyedBlock& block : survey.blocks) take_shapes(block, *plan);
  } catch (const ModelError&) {
    if (!incomplete) throw;
    survey.complete = false;
    for (SurveyedBlock& block : survey.blocks) guess_shapes(block);
  }
  return survey;
}

}  // namespace saltus::python
