// Declarations shared by the passes of a picture.
#pragma once

#include "saltus/plan/picture.hpp"

namespace saltus::detail {

/// How an input of a leaf is read.
struct Reading {
  bool flow = false;   // by a derivative, or by an output that is itself read
  bool event = false;  // by a guard, a reset map or an update
};

/// The readings of each input of each leaf of a plan.
using Readings = std::vector<std::vector<Reading>>;
Readings readings_of(const Plan& plan);

/// The rate of a leaf in the plan, or the answer that it is never computed.
Picture::Flow flow_of(const Plan& plan, const PlanLeaf& leaf);
/// The rate of the value on a wire, likewise.
Picture::Flow flow_of(const Node& node);

/// Lines below the name of a leaf: its states, modes, zero crossings and time events. Without a
/// plan it is not known how its booleans are located.
std::vector<std::string> notes_of(const LeafSystem& leaf, const Plan* plan, int number);
/// An execution in few words: "triggers ↑".
std::string words_of(const Execution& execution);
/// A zero crossing in few words: "bounce ↓ reset".
std::string words_of(const ZeroCrossing& crossing);

}  // namespace saltus::detail
