// What the passes of a picture share.
#pragma once

#include "saltus/plan/picture.hpp"

namespace saltus::detail {

/// How an input of a leaf is read.
struct Reading {
  bool flow = false;   // by a derivative, or by an output that somebody reads
  bool event = false;  // by a guard, a reset map or an update
};

/// For each leaf of a plan and each of its inputs.
using Readings = std::vector<std::vector<Reading>>;
Readings readings_of(const Plan& plan);

/// What the plan makes of a leaf: how often it is computed, or that it never is.
Picture::Flow flow_of(const Plan& plan, const PlanLeaf& leaf);
/// The same of the value on a wire.
Picture::Flow flow_of(const Node& node);

/// Lines under the name of a leaf: its states, modes, zero crossings and time events. Without a
/// plan how its booleans are located is not known.
std::vector<std::string> notes_of(const LeafSystem& leaf, const Plan* plan, int number);
/// A zero crossing in few words: "bounce ↓ reset".
std::string words_of(const ZeroCrossing& crossing);

}  // namespace saltus::detail
