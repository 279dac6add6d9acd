// Where a step is cut at an event inside it.
#pragma once

#include <algorithm>

#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// The length of the step that is solved again to end just beyond a root at offset `root` of a step
/// of `length`; 0 if the step need not be cut. `off`: the error of the dense output there, in parts
/// of the root.
///
///     the root is                              the step
///     next to the begin                        stays: its polynomial is as good as the state there
///     nearer to the end than the cut would be  stays
///     elsewhere                                ends ten times as far beyond the root as it may be off
inline double cut_length(double root, double length, double off) {
  if (!(root > tuning::near_begin * length)) return 0.0;
  const double further =
      std::clamp(tuning::beyond * off, tuning::least_beyond, tuning::most_beyond);
  const double h = root * (1.0 + further);
  return h < length ? h : 0.0;
}

}  // namespace saltus::radau
