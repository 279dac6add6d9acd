// Soundness: the faults of a diagram that `build` refuses before anything runs.
#pragma once

#include "saltus/model/diagram.hpp"

namespace saltus::detail {

/// Refuses algebraic loops, and inputs of another width than their source, as far as the
/// declarations of the blocks show them. The inputs of the diagram are still open, and no function
/// of a user is called. compile() refuses all other wrong shapes before a run.
void require_sound(const Diagram& diagram);

}  // namespace saltus::detail
