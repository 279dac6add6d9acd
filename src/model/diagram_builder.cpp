// DiagramBuilder: blocks and wires are checked and collected.
#include "saltus/model/diagram_builder.hpp"
#include "saltus/base/list.hpp"

#include <algorithm>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/detail/diagram_parameters.hpp"
#include "saltus/model/detail/names.hpp"
#include "saltus/model/detail/soundness.hpp"
#include "saltus/model/leaf_system.hpp"

namespace saltus {

DiagramBuilder::DiagramBuilder() = default;
DiagramBuilder::~DiagramBuilder() = default;
DiagramBuilder::DiagramBuilder(DiagramBuilder&&) noexcept = default;
DiagramBuilder& DiagramBuilder::operator=(DiagramBuilder&&) noexcept = default;

void DiagramBuilder::add(std::shared_ptr<const System> block) {
  require_unspent();
  std::string name =
      block->name().empty() ? text("block_", block->system_id().value) : block->name();
  if (mine_.contains(block.get())) throw BuilderError(text("block '", name, "' is added twice"));
  if (!names_.insert(name).second) {
    throw SystemNameNotUniqueError(
        text("two blocks are called '", name, "'; give each block of a diagram its own name"));
  }
  mine_.emplace(block.get(), diagram_.children_.size());
  diagram_.children_.push_back({std::move(block), std::move(name)});
}

void DiagramBuilder::connect(OutputPort from, InputPort to) {
  require_mine(from.system);
  from = from.system->output(from.index);
  require_free(to);
  sources_.emplace(std::pair(to.system, to.index), diagram_.wires_.size());
  diagram_.wires_.push_back({from, to});
}

void DiagramBuilder::execute(const System& block, OutputPort control, Execution execution) {
  require_mine(&block);
  require_mine(control.system);
  control = control.system->output(control.index);
  const std::string name = name_of(&block);
  if (&block == control.system)
    throw BuilderError(text("block '", name, "' cannot control its own execution"));
  if (std::ranges::find(diagram_.controlled_, &block, &Diagram::Controlled::child) !=
      diagram_.controlled_.end())
    throw BuilderError(text("block '", name, "' already has a control signal; it takes one"));
  diagram_.controlled_.push_back({&block, control, execution});
}

int DiagramBuilder::export_input(InputPort port, std::string name) {
  require_free(port);
  if (name.empty()) name = text(name_of(port.system), "_", port_name(port));
  detail::name_it(name, diagram_.inputs_, "in_", "the diagram");
  name = detail::without_dot(std::move(name), "input");
  diagram_.inputs_.push_back({std::move(name), port});
  return static_cast<int>(diagram_.inputs_.size()) - 1;
}

int DiagramBuilder::export_output(OutputPort port, std::string name) {
  require_mine(port.system);
  port = port.system->output(port.index);
  if (name.empty()) {
    name = text(name_of(port.system), "_", nth(port.system->output_names(), port.index));
  }
  detail::name_it(name, diagram_.outputs_, "out_", "the diagram");
  name = detail::without_dot(std::move(name), "output");
  diagram_.outputs_.push_back({std::move(name), port});
  return static_cast<int>(diagram_.outputs_.size()) - 1;
}

Diagram DiagramBuilder::build(std::string name) {
  require_unspent();
  if (diagram_.children_.empty())
    throw EmptyDiagramError("build: the diagram has no block; add one first");
  for (const auto& child : diagram_.children_) {
    const auto ports = child.system->input_names();
    for (int i = 0; i < static_cast<int>(ports.size()); ++i) {
      if (!child.system->fixes_input(i) && source_of({child.system.get(), i}).empty()) {
        throw InputNotConnectedError(text("input '", ports[i], "' of block '", child.name,
                                          "' is not connected; connect it or export it"));
      }
    }
  }
  for (const auto& [input, wire] : sources_) {
    if (input.first->fixes_input(input.second)) throw_two_sources({input.first, input.second});
  }
  detail::require_sound(diagram_);
  require_computed_once();
  Diagram built(detail::without_dot(std::move(name), "diagram"));
  spent_ = true;
  built.children_ = std::move(diagram_.children_);
  built.wires_ = std::move(diagram_.wires_);
  built.event_wires_ = std::move(diagram_.event_wires_);
  built.event_outputs_ = std::move(diagram_.event_outputs_);
  built.event_inputs_ = std::move(diagram_.event_inputs_);
  built.controlled_ = std::move(diagram_.controlled_);
  built.inputs_ = std::move(diagram_.inputs_);
  built.outputs_ = std::move(diagram_.outputs_);
  built.parameters_ = std::move(parameters_);
  built.computed_ = std::move(diagram_.computed_);
  for (const Diagram::Child& child : built.children_) {
    const auto* leaf = dynamic_cast<const LeafSystem*>(&child.system->itself());
    if (leaf != nullptr) built.uses_.push_back(leaf->declarations().use);
  }
  return built;
}

void DiagramBuilder::require_unspent() const {
  if (spent_) throw BuilderError("this DiagramBuilder was spent by build(); make a new one");
}

void DiagramBuilder::require_mine(const System* system) const {
  require_unspent();
  if (system == nullptr)
    throw BuilderError("the port belongs to no block; take it from one, such as block.output()");
  if (!mine_.contains(system)) {
    throw BuilderError(text("block '", system->name(),
                            "' was not added to this diagram; its blocks: ",
                            quoted_list(detail::names_of(diagram_.children_))));
  }
}

void DiagramBuilder::require_free(InputPort to) const {
  require_mine(to.system);
  to = to.system->input(to.index);
  if (const std::string source = source_of(to); !source.empty()) {
    throw BuilderError(text("input '", port_name(to), "' of block '", name_of(to.system),
                            "' already has a source, ", source, "; an input takes one"));
  }
}

void DiagramBuilder::throw_two_sources(InputPort to) const {
  throw BuilderError(text("input '", port_name(to), "' of block '", name_of(to.system),
                          "' has two sources: a wire and its fixed value; an input takes one"));
}

std::string DiagramBuilder::source_of(InputPort to) const {
  if (to.system->fixes_input(to.index)) return "its fixed value";
  if (const auto wire = sources_.find({to.system, to.index}); wire != sources_.end())
    return text("block '", name_of(diagram_.wires_[wire->second].from.system), "'");
  for (const auto& input : diagram_.inputs_) {
    if (input.port.system == to.system && input.port.index == to.index)
      return text("the exported input '", input.name, "'");
  }
  return {};
}

std::string DiagramBuilder::name_of(const System* system) const {
  return diagram_.children_[mine_.at(system)].name;
}

std::string DiagramBuilder::port_name(InputPort port) {
  return nth(port.system->input_names(), port.index);
}

}  // namespace saltus
