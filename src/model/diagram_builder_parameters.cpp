// DiagramBuilder: the parameters of the diagram, and those of its blocks that it computes from them.
#include <algorithm>
#include <set>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/computed_parameter.hpp"
#include "saltus/model/detail/diagram_parameters.hpp"
#include "saltus/model/diagram_builder.hpp"

namespace saltus {

namespace {

/// The leaf that holds the parameters of a system.
const LeafSystem& holder_of(const System& system) {
  if (const auto* leaf = dynamic_cast<const LeafSystem*>(&system.itself())) return *leaf;
  const auto* diagram = dynamic_cast<const Diagram*>(&system.itself());
  if (diagram != nullptr && diagram->parameters() != nullptr) return *diagram->parameters();
  throw ModelError(
      text("compute_parameter: diagram '", system.name(),
           "' has no parameters of its own; name the block in it whose parameter is meant"));
}

void require_parameter(const LeafSystem& leaf, std::string_view name, Index size) {
  std::vector<std::string> known;
  for (const Layout::Parameter& one : leaf.declarations().parameters) {
    if (one.name == name && one.size == size) return;
    if (one.name == name)
      throw ModelError(text("compute_parameter: parameter '", name, "' of block '", leaf.name(),
                            "' has ", one.size, " values, the function gives ", size));
    known.push_back(one.name);
  }
  throw ModelError(text("compute_parameter: block '", leaf.name(), "' has no parameter '", name,
                        "'", known_names(name, known)));
}

}  // namespace

DiagramParameters& DiagramBuilder::parameters() {
  require_unspent();
  if (!parameters_) parameters_ = std::make_shared<DiagramParameters>("the diagram");
  return *parameters_;
}

ParameterIndex DiagramBuilder::declare_parameter(std::string name, double value) {
  return parameters().declare_dynamic_parameter(std::move(name), value);
}

ParameterIndex DiagramBuilder::declare_parameter(std::string name, const Eigen::VectorXd& value) {
  return parameters().declare_dynamic_parameter(std::move(name), value);
}

tape::Tape DiagramBuilder::tape_of(tape::Graph& graph, const tape::Symbol& value) {
  return tape_of(graph, std::vector{value});
}

tape::Tape DiagramBuilder::tape_of(tape::Graph& graph, const std::vector<tape::Symbol>& values) {
  std::vector<tape::Node> nodes;
  for (const tape::Symbol& value : values) nodes.push_back(value.in(graph));
  return {graph, nodes};
}

void DiagramBuilder::compute_parameter(const System& block, std::string_view parameter,
                                       tape::Tape values) {
  const DiagramParameters& from = parameters();
  const LeafSystem& leaf = holder_of(block);
  require_parameter(leaf, parameter, values.size());
  const Eigen::VectorXd& p = from.declarations().parameter_values;
  values.check(at_parameters(p.data(), p.size()));
  diagram_.computed_.push_back(
      {&leaf, std::string(parameter), std::make_shared<const tape::Tape>(std::move(values))});
}

void DiagramBuilder::require_computed_once() const {
  if (diagram_.computed_.empty()) return;
  const Structure structure = structure_of(diagram_);
  std::set<const LeafSystem*> known;
  for (const Structure::Leaf& leaf : structure.leaves) known.insert(leaf.system);
  std::set<std::pair<const LeafSystem*, std::string_view>> seen;
  for (const Structure::Computed& one : structure.computed) {
    if (!known.contains(one.leaf))
      throw BuilderError(text("build: parameter '", one.parameter, "' of block '", one.leaf->name(),
                              "' is computed, but the block is not in this diagram"));
    if (!seen.emplace(one.leaf, one.parameter).second)
      throw BuilderError(text("build: parameter '", one.parameter, "' of block '", one.leaf->name(),
                              "' is computed twice"));
  }
}

}  // namespace saltus
