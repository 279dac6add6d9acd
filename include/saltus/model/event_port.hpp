// Event ports: the events of a leaf that wires may start from, and the inputs that they lead to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/base/callback.hpp"
#include "saltus/base/ids.hpp"

namespace saltus {

class LeafSystem;
class System;

/// An input for events of other leaves. Each delivery of a wire applies the reset map: x+ from x-,
/// and from the weight of the wire. `Delivery::weight()` is the weight, `At::entry` the entry that
/// the wire leads to.
struct EventInputDeclaration {
  std::string name = {};
  DeliveryMap reset_map = {};
  Index size = 1;  ///< number of entries that wires may lead to
  std::optional<std::vector<int>> inputs =
      {};  ///< the inputs the reset map reads; all if not given
};

/// An event of a system that wires may start from: a zero crossing or a time event.
struct EventOutputPort {
  const System* system = nullptr;
  int index = 0;
  std::optional<Index> entry = {};  ///< of a vector of guards: the guard that fires
};

/// An input of a system for events.
struct EventInputPort {
  const System* system = nullptr;
  int index = 0;
  std::optional<Index> entry = {};  ///< of an input of several entries
};

/// An event, or an input for events, of a leaf, after all nesting is resolved.
struct LeafEvent {
  const LeafSystem* leaf = nullptr;
  int index = 0;   ///< an event: the zero crossings of the leaf come first, then its time events
  Index size = 1;  ///< its entries
};

}  // namespace saltus
