// Diagram: its ports and its children.
#include "saltus/model/diagram.hpp"

#include <algorithm>

#include "saltus/model/detail/names.hpp"

namespace saltus {

std::vector<std::string> Diagram::input_names() const { return detail::names_of(inputs_); }

std::vector<std::string> Diagram::output_names() const { return detail::names_of(outputs_); }

bool Diagram::fixes_input(int index) const {
  const InputPort& port = nth(inputs_, index).port;
  return System::fixes_input(index) || port.system->fixes_input(port.index);
}

LeafPort Diagram::output_source(int index) const {
  const OutputPort& port = outputs_[index].port;
  return port.system->output_source(port.index);
}

LeafPort Diagram::input_target(int index) const {
  const InputPort& port = inputs_[index].port;
  return port.system->input_target(port.index);
}

std::vector<std::string> Diagram::event_output_names() const {
  return detail::names_of(event_outputs_);
}

std::vector<std::string> Diagram::event_input_names() const {
  return detail::names_of(event_inputs_);
}

LeafEvent Diagram::event_source(int index) const {
  const EventOutputPort& port = event_outputs_[index].port;
  return port.system->event_source(port.index);
}

LeafEvent Diagram::event_target(int index) const {
  const EventInputPort& port = event_inputs_[index].port;
  return port.system->event_target(port.index);
}

const System& Diagram::operator[](std::string_view child) const {
  const auto found = std::ranges::find(children_, child, &Child::name);
  if (found != children_.end()) return *found->system;
  throw ModelError(text("diagram '", name(), "' has no block '", child, "'",
                        known_names(child, detail::names_of(children_))));
}

void Diagram::collect(Structure& out, const std::string& path) const {
  const std::size_t mine = out.systems.size();
  out.systems.push_back(
      {system_id(), path.empty() ? name() : path, out.leaves.size(), out.leaves.size()});
  for (const Computed& one : computed_)
    out.computed.push_back({one.leaf, one.parameter, parameters_.get(), one.values});
  for (const Child& child : children_) {
    const std::size_t first = out.leaves.size();
    child.system->collect(out, path.empty() ? child.name : path + "." + child.name);
    const auto control = std::ranges::find(controlled_, child.system.get(), &Controlled::child);
    if (control == controlled_.end()) continue;
    const OutputPort& port = control->control;
    out.controlled.push_back(
        {first, out.leaves.size(), port.system->output_source(port.index), control->execution});
  }
  for (const Wire& wire : wires_) {
    out.wires.push_back({wire.from.system->output_source(wire.from.index),
                         wire.to.system->input_target(wire.to.index)});
  }
  for (const EventWire& wire : event_wires_) {
    out.event_wires.push_back({wire.from.system->event_source(wire.from.index),
                               wire.to.system->event_target(wire.to.index),
                               static_cast<int>(*wire.from.entry), static_cast<int>(*wire.to.entry),
                               wire.weight, wire.delay});
  }
  if (parameters_ != nullptr) out.leaves.push_back({parameters_.get(), path});
  out.systems[mine].last = out.leaves.size();
  collect_fixed(out);
}

}  // namespace saltus
