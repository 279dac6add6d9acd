// DiagramBuilder: event wires, and events of blocks as events of the diagram.
#include <cmath>

#include "saltus/base/model_errors.hpp"
#include "saltus/model/detail/names.hpp"
#include "saltus/model/diagram_builder.hpp"

namespace saltus {

namespace {

void require_wire(const std::string& source, const std::string& target, double weight,
                  double delay) {
  const std::string what = text("event wire from '", source, "' to '", target, "': ");
  if (!std::isfinite(weight))
    throw BuilderError(text(what, "weight ", weight, "; expected a finite number"));
  if (!std::isfinite(delay) || delay < 0.0)
    throw BuilderError(text(what, "delay ", delay, " s; expected a finite time >= 0 s"));
}

/// Refuses an entry: an exported event has all of them.
template <class Port>
void require_all_entries(const Port& port, const std::string& block) {
  if (!port.entry) return;
  throw BuilderError(text("block '", block, "': entry ", *port.entry,
                          " of an event cannot be exported alone; export the event, and name the "
                          "entry where the wire is made"));
}

}  // namespace

void DiagramBuilder::connect_event(EventOutputPort from, EventInputPort to, double weight,
                                   double delay) {
  require_mine(from.system);
  require_mine(to.system);
  from = from.system->event_output(from.index, from.entry);
  to = to.system->event_input(to.index, to.entry);
  from.entry = from.system->entry_of(from);
  to.entry = to.system->entry_of(to);
  if (!std::isfinite(weight) || !std::isfinite(delay) || delay < 0.0)
    require_wire(
        text(name_of(from.system), ".", nth(from.system->event_output_names(), from.index)),
        text(name_of(to.system), ".", nth(to.system->event_input_names(), to.index)), weight,
        delay);
  diagram_.event_wires_.push_back({from, to, weight, delay});
}

int DiagramBuilder::export_event_output(EventOutputPort port, std::string name) {
  require_mine(port.system);
  require_all_entries(port, name_of(port.system));
  const std::string event = nth(port.system->event_output_names(), port.index);
  if (name.empty()) name = text(name_of(port.system), "_", event);
  detail::name_it(name, diagram_.event_outputs_, "event_out_", "the diagram");
  name = detail::without_dot(std::move(name), "event");
  diagram_.event_outputs_.push_back({std::move(name), port});
  return static_cast<int>(diagram_.event_outputs_.size()) - 1;
}

int DiagramBuilder::export_event_input(EventInputPort port, std::string name) {
  require_mine(port.system);
  require_all_entries(port, name_of(port.system));
  const std::string input = nth(port.system->event_input_names(), port.index);
  if (name.empty()) name = text(name_of(port.system), "_", input);
  detail::name_it(name, diagram_.event_inputs_, "event_in_", "the diagram");
  name = detail::without_dot(std::move(name), "event input");
  diagram_.event_inputs_.push_back({std::move(name), port});
  return static_cast<int>(diagram_.event_inputs_.size()) - 1;
}

}  // namespace saltus
