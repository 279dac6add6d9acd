// Event wires of a plan: for each source its targets, in flat lists.
#pragma once

#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/base/view.hpp"

namespace saltus {

/// A wire from an event to an input for events, both of leaves.
struct EventWire {
  int from = -1;       ///< leaf
  int event = 0;       ///< its zero crossings come first, then its time events
  int from_entry = 0;  ///< of a vector of guards
  int to = -1;         ///< leaf
  int input = 0;       ///< its event input
  int to_entry = 0;
  double weight = 1.0;
  double delay = 0.0;  ///< [s]
  int number = 0;      ///< in the order of declaration, also in the plan of an island
};

/// A source is one guard of a zero crossing, by its place among all guards, or a time event, which
/// come after the guards. The wires of a source that have one delay are a batch. A firing costs one
/// entry for each batch, and a delivery one call for each target.
struct EventWires {
  struct Target {
    int leaf, input, entry;
    int number;  ///< of the wire, in the order of declaration
    double weight;
  };
  struct Batch {
    int source;
    double delay;     ///< [s]
    int first, last;  ///< its targets are first to last - 1
  };

  /// An event whose wires lead out of the plan of an island.
  struct Sender {
    int leaf, event, entry;
    auto operator<=>(const Sender&) const = default;
  };

  std::vector<EventWire> declared = {};
  std::vector<Sender> senders = {};  ///< of wires to other islands, each once, in order
  bool receives_outside = false;     ///< wires of other islands may lead here
  List<Target> targets = {};         ///< batch after batch, each in the order of declaration
  List<Batch> batches = {};          ///< by source, then by delay
  List<int> first_batch = {};        ///< of each source, and of the source after the last
  List<char> sends_outside = {};     ///< of each source; empty if there are no senders
  Place weight = {};  ///< of the weight under way, behind the inputs of its reset map

  bool any() const noexcept { return !declared.empty() || !senders.empty() || receives_outside; }
};

}  // namespace saltus
