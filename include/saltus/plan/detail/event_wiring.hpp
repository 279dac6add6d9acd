// Event wiring: the event wires of a structure, resolved, and sorted by their sources.
#pragma once

#include "saltus/plan/detail/fixed_inputs.hpp"

namespace saltus::detail {

/// Finds the leaves of all event wires. Throws ModelError for a wire from or to a leaf in a part
/// that a control signal executes.
void add_event_wires(Plan& plan, const Structure& structure, const LeafNumbers& numbers);

/// Marks the leaves that receive, after `EventWires::declared` is complete.
void mark_receivers(Plan& plan);

/// Gives the weight of a delivery a place, as an input behind the other inputs of each leaf that
/// receives.
void place_weight(Plan& plan);

/// The number of a source; -1 for an event that never happens, or that the plan does not have.
int event_source_of(const Plan& plan, int leaf, int event, int entry);

/// An event, and its entry, by the number of its source.
struct EventOrigin {
  int leaf, event, entry;
};
EventOrigin event_origin_of(const Plan& plan, int source);
/// Its name.
const std::string& event_name(const Plan& plan, int source);

/// Sorts the wires by source and delay, after guards and schedule are complete. A wire from an event
/// that never happens is left out.
void sort_event_wires(Plan& plan);

}  // namespace saltus::detail
