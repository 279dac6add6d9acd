// Length and order of the next step: functions of what the last steps have shown.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/radau/scheme.hpp"

namespace saltus::radau {

/// The error estimate that a step may have [tolerances]. The estimate shrinks as h^(S + 1), the
/// error of the step as h^(2 S). 0.1 rtol^((S + 1) / (2 S)) in place of rtol lets the step be as long
/// as its own error allows (the codes RADAU5 and RADAU by Hairer and Wanner). The collocation
/// polynomial has the order of the estimate. Beyond `dense_room` times 2^(S + 1) of its own error
/// two halves of a step would not bring it within the tolerance.
inline double allowed_estimate(const Scheme& scheme, double rtol, double dense_room) {
  const double part = scheme.estimate_order() / scheme.local_order();
  const double by_order = 0.1 * std::pow(rtol, part - 1.0);
  const double by_dense = dense_room * std::exp2(scheme.estimate_order()) / scheme.dense_share;
  return std::min(by_order, by_dense);
}

/// The estimate that a component may have, in units of its tolerance: all that is `allowed` for a
/// slow part, 1 for a fast part. There the error of a step has the order of the estimate too, for it
/// follows the stages (A. Prothero, A. Robinson, "On the stability and accuracy of one-step methods
/// for solving stiff systems", Math. Comp. 28 (1974) 145; Hairer, Wanner II, IV.15). `share` is the
/// part of the estimate that the filter gamma (gamma - h J)^-1 leaves: 1 for a slow part, gamma / h
/// |lambda| for a fast one.
inline double allowed_of_part(double allowed, double share) {
  return allowed > 1.0 ? std::pow(allowed, std::min(share, 1.0)) : allowed;
}

/// Predictive control of the step size (K. Gustafsson, "Control-theoretic techniques for stepsize
/// selection in implicit Runge-Kutta methods", ACM TOMS 20 (1994) 496; Hairer, Wanner II, IV.8,
/// (8.25)). An error of 1 is allowed.
class PredictiveControl {
 public:
  /// The step after an accepted step of length h.
  double accept(double error, double h, double order, double safety, bool after_rejection) {
    double factor = next(error, order, safety);
    const double now = std::max(error, least_error);
    if (h_ > 0.0) {
      const double trend = h / h_ * std::pow(error_ / (now * now), 1.0 / order) * safety;
      factor = std::min(factor, std::max(trend, shortest));
    }
    h_ = h, error_ = now;
    return h * (after_rejection ? std::min(factor, 1.0) : factor);
  }
  /// The step after a rejected step of length h.
  static double reject(double error, double h, double order, double safety) {
    return h * std::min(next(error, order, safety), 0.9);
  }
  /// The last step says nothing about the next.
  void forget() { h_ = 0.0; }

 private:
  static constexpr double shortest = 0.1, longest = 8.0, least_error = 1e-2;
  static double next(double error, double order, double safety) {
    return std::clamp(safety * std::pow(std::max(error, 1e-20), -1.0 / order), shortest, longest);
  }

  double h_ = 0.0, error_ = 0.0;  // of the last accepted step
};

/// The safety of a step size: the less, the more of the allowed iterations Newton took (IV.8, p. 124).
inline double safety_of(int iterations, int most) {
  return 0.9 * (1.0 + 2.0 * most) / (iterations + 2.0 * most);
}

/// Whether a step longer by this factor saves less than the factorisation that it costs (the code
/// RADAU5).
constexpr bool not_worth_it(double factor) { return factor >= 1.0 && factor < 1.2; }

/// What a choice of the order depends on.
struct OrderFacts {
  int stages = 3;
  double theta = 0.0;  ///< contraction of Newton's iteration in the last steps
  double ratio = 1.0;  ///< of the lengths of the last two steps
  int steps = 0;       ///< accepted with these stages
  bool newton_failed = false;
  int highest = 7;
};

/// The stages of the next step (Hairer, Wanner, J. Comput. Appl. Math. 111 (1999) 93, section 4):
///
///   Newton's iteration failed, or theta >= 0.8           fewer
///   theta <= 0.002 after ten steps of nearly one length  more
///   otherwise                                            as many
inline int next_stages(const OrderFacts& facts) {
  if (facts.newton_failed || facts.theta >= 0.8) return std::max(facts.stages - 2, 3);
  const bool steady = facts.ratio > 0.8 && facts.ratio < 1.2 && facts.steps >= 10;
  return steady && facts.theta <= 0.002 ? std::min(facts.stages + 2, facts.highest) : facts.stages;
}

}  // namespace saltus::radau
