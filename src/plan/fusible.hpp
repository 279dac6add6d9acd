// Fusible: which formulas a plan may join with their neighbours.
#pragma once

#include "saltus/model/formula.hpp"

namespace saltus::detail {

/// A wider signal is not fused, because its numbers cost more than the call, and a call computes
/// them side by side.
inline constexpr Index widest_fused = 16;

/// Whether there is a formula that is narrow enough to be looked into.
inline bool is_narrow(const Formula& formula, Index size) {
  return formula && size <= widest_fused;
}

/// The formula, if it may be joined with others and is narrow enough; otherwise null.
inline const Formula* fusible(const Formula& formula, Index size) {
  return is_narrow(formula, size) && formula.joins() ? &formula : nullptr;
}

}  // namespace saltus::detail
