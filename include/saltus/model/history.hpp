// History: the record that a leaf keeps of one of its inputs.
#pragma once

#include <functional>
#include <limits>
#include <span>

#include "saltus/base/view.hpp"

namespace saltus {

/// A step that the run has accepted, as the `append` of a History gets it. The held signals, the
/// discrete states and the modes are those of the whole step.
struct AcceptedStep {
  double from, to;     ///< [s]
  bool after_instant;  ///< something changed in the instant at `from`, or the run began there
  double rtol, atol;   ///< tolerances of the run; the smallest if each state has its own
  /// Writes the input at a time within the step, as the dense output of the solver has it.
  const std::function<void(double t, std::span<double> u)>& input;
  /// It is the first step of a run that continues another. The instant that ended that one may have
  /// changed something.
  bool continues = false;
};

/// A record that a leaf makes of an input, step by step, in its discrete state. It is part of the
/// context, so it is saved, loaded and resumed with it.
///
/// `append` is called once after each accepted step, and writes the discrete state z. This is no
/// event: it makes no row, and restarts no solver. So the values that `append` writes must not
/// change an output of the leaf at the end of the step, nor before. An output that reads the past
/// only up to t - d keeps this rule if no step is longer than d; `longest_step` is that bound.
struct History {
  int input = 0;
  std::function<void(const AcceptedStep&, VectorRef z)> append = {};
  double longest_step = std::numeric_limits<double>::infinity();  ///< [s]
};

}  // namespace saltus
