// Soundness: what `build` refuses in a diagram before anything runs.
#pragma once

#include "saltus/model/diagram.hpp"

namespace saltus::detail {

/// Refuses algebraic loops, and inputs of another width than their source, as far as the
/// declarations of the blocks tell: an input of the diagram is open, and no function of a user is
/// called. Every other shape is refused before a run.
void require_sound(const Diagram& diagram);

}  // namespace saltus::detail
