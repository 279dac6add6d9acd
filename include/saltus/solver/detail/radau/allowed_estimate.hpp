// The error estimate that a step may have, and the part of it that the step does not answer for.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/radau/scheme.hpp"
#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// The relative tolerance that a step is held to, at states of this size [tolerances, root mean
/// square]: rtol, or a part of 1 / size where the absolute tolerances are the larger part. With
/// atol = k rtol |x| the size is 1 / (rtol (1 + k)).
inline double relative_tolerance(double rtol, double size) {
  return std::max(rtol, std::min(tuning::absolute_part / size, 1.0));
}

/// The error estimate that a slow part may have [tolerances]. The estimate shrinks as h^(S + 1),
/// the error of the step as h^(2 S). 0.1 rtol^((S + 1) / (2 S)) in place of rtol lets the step be
/// as long as its own error allows (the codes RADAU5 and RADAU by Hairer and Wanner). The
/// collocation polynomial has the order of the estimate. Beyond `dense_room` times 2^(S + 1) of its
/// own error two halves of a step would not bring it within the tolerance.
inline double slow_estimate(const Scheme& scheme, double rtol, double dense_room) {
  const double part = scheme.estimate_order() / scheme.local_order();
  const double by_order = 0.1 * std::pow(rtol, part - 1.0);
  const double by_dense = dense_room * std::exp2(scheme.estimate_order()) / scheme.dense_share;
  return std::min(by_order, by_dense);
}

/// The error estimate that a fast part may have [tolerances]. A fast part follows the stages (A.
/// Prothero, A. Robinson, "On the stability and accuracy of one-step methods for solving stiff
/// systems", Math. Comp. 28 (1974) 145; Hairer, Wanner II, IV.15): x' = lambda (x - g) + g' leaves
/// the error (p' - g') / lambda at the end of a step, and the estimate is the same at its begin,
/// where p is the collocation polynomial. With w(s) = s (s - c_1) ... (s - c_S), g - p is w times a
/// constant, and w'(1) / w'(0) is S, or -S. So the error is S times the estimate.
inline double fast_estimate(const Scheme& scheme, double slow) {
  return std::min(slow, tuning::fast_error / scheme.stages);
}

/// What both allow for a component, by the `share` of its estimate that the filter
/// gamma (gamma - h J)^-1 leaves: 1 for a slow part, gamma / h |lambda| for a fast one. The
/// logarithm is linear in between.
class AllowedEstimate {
 public:
  AllowedEstimate(const Scheme& scheme, double rtol, double dense_room)
      : slow_(slow_estimate(scheme, rtol, dense_room)),
        log_fast_(std::log2(fast_estimate(scheme, slow_))),
        log_span_(std::log2(slow_) - log_fast_) {}

  double of(double share) const {
    return share < 1.0 ? std::exp2(log_fast_ + share * log_span_) : slow_;
  }

 private:
  double slow_, log_fast_, log_span_;
};

/// How much of the order of the estimate two tries of one step show, 0 to 1; `ratio` is the length of the
/// second in the first. The error of a step is much smaller than its estimate only where both shrink as
/// on a smooth solution. An estimate that shrinks by less than half of its order is the error itself:
/// behind a jump of the derivative it shrinks as h, behind a kink as h^2.
inline double shown_order(double before, double now, double ratio, double order) {
  if (now == 0.0) return 1.0;
  const double shown = std::log(std::abs(before / now)) / -std::log(ratio);
  return std::clamp(2.0 * shown / order - 1.0, 0.0, 1.0);
}

/// Whether the first estimate of a step is much larger than that of the step before says, in
/// tolerances; `ratio` is the length of the step in that of the one before.
inline bool is_sudden(double now, double before, double ratio, double order) {
  const double expected = std::max(before * std::pow(ratio, order), tuning::least_estimate);
  return now > tuning::sudden * expected;
}

/// The part of a fast estimate that the step has inherited: the distance of the state at its begin
/// from the slow solution, which the step damps, and which no shorter step has less of. Two tries
/// of one step tell it apart: their estimates are a + b and a + `shrunk` b with a the inherited
/// part and b the step's own, which shrinks as h^S. At most `bound` is excused: an error of that
/// size is allowed inside of steps, a larger one is a transient to be resolved.
inline double inherited_estimate(double before, double now, double shrunk, double bound) {
  return std::clamp((now - shrunk * before) / (1.0 - shrunk), -bound, bound);
}

}  // namespace saltus::radau
