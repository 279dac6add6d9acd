// Whether a step may go along the derivative where Newton's iteration does not converge.
#pragma once

#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// Whether a step is so short that it may go along the derivative at its begin: `moved` is how far
/// a derivative takes the states in it [tolerances]. That has to be so for the derivatives at all
/// stages: those of a quantity that rests, and is turned on within a long step, are not all small.
inline bool is_small(double moved) { return moved <= tuning::small_move; }

/// Whether the derivative jumps in such a step, from f0 to f1.
template <class Vector>
bool jumps(const Vector& f0, const Vector& f1) {
  return (f1 - f0).norm() > tuning::large_turn * f0.norm();
}

}  // namespace saltus::radau
