// Event ports of a system, by name.
#include <algorithm>

#include "saltus/model/system.hpp"

namespace saltus {

namespace {

constexpr std::string_view output_kind = "event that a wire may start from,",
                           input_kind = "event input";

}  // namespace

EventOutputPort System::event_output(int index, std::optional<Index> entry) const {
  const EventOutputPort port{this, checked(index, event_output_names(), output_kind), entry};
  if (entry) entry_of(port);
  return port;
}

EventInputPort System::event_input(int index, std::optional<Index> entry) const {
  const EventInputPort port{this, checked(index, event_input_names(), input_kind), entry};
  if (entry) entry_of(port);
  return port;
}

Index System::entry_of(const EventOutputPort& port) const {
  return checked_entry(event_source(port.index), port.entry, "event",
                       nth(event_output_names(), port.index));
}

Index System::entry_of(const EventInputPort& port) const {
  return checked_entry(event_target(port.index), port.entry, input_kind,
                       nth(event_input_names(), port.index));
}

EventOutputPort System::event_output(std::string_view event, std::optional<Index> entry) const {
  const std::vector<std::string> names = event_output_names();
  if (std::ranges::count(names, event) > 1)
    throw ModelError(text("block '", name_, "' has a zero crossing and a time event called '",
                          event, "'; give them names of their own"));
  return event_output(find(event, names, output_kind), entry);
}

EventInputPort System::event_input(std::string_view port, std::optional<Index> entry) const {
  return event_input(find(port, event_input_names(), input_kind), entry);
}

Index System::checked_entry(const LeafEvent& of, std::optional<Index> entry, std::string_view kind,
                            const std::string& port) const {
  if (!entry && of.size == 1) return 0;
  if (entry && *entry >= 0 && *entry < of.size) return *entry;
  throw ModelError(text("block '", name_, "': ", kind, " '", port, "' has ", of.size,
                        of.size == 1 ? " entry" : " entries", "; expected the number of one, 0 to ",
                        of.size - 1, ", found ", entry ? text(*entry) : "none"));
}

LeafEvent System::event_source(int index) const {
  throw ModelError(text("block '", name_, "' has no event ", index));
}
LeafEvent System::event_target(int index) const {
  throw ModelError(text("block '", name_, "' has no event input ", index));
}

}  // namespace saltus
