// Whether a step may go along the derivative where Newton's iteration does not converge.
#pragma once

#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// Whether a step is so short that it may go along the derivative at its begin: `first` and `last`
/// are how far the derivatives at its begin and at its end would take the states [tolerances]. A
/// quantity that rests at the begin, and turns on within a long step, moves by the second one.
inline bool is_small(double first, double last) {
  return first <= tuning::small_move && last <= tuning::small_move;
}

/// Whether the derivative jumps in such a step, from f0 to f1.
template <class Vector>
bool jumps(const Vector& f0, const Vector& f1) {
  return (f1 - f0).norm() > tuning::large_turn * f0.norm();
}

}  // namespace saltus::radau
