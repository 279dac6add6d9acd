// Fusible: which formulas a plan may join with their neighbours.
#pragma once

#include "saltus/model/formula.hpp"

namespace saltus::detail {

/// A wider signal is not fused, because its numbers cost more than the call, and a call computes
/// them side by side.
inline constexpr Index widest_fused = 16;

/// The formula, if it may be joined with others and is narrow enough; otherwise null.
inline const Formula* fusible(const Formula& formula, Index size) {
  return formula && formula.joins() && size <= widest_fused ? &formula : nullptr;
}

}  // namespace saltus::detail
