// Length and order of the next step: functions of the record of the last steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/radau/scheme.hpp"
#include "saltus/solver/detail/radau/tuning.hpp"

namespace saltus::radau {

/// Predictive control of the step size (K. Gustafsson, "Control-theoretic techniques for stepsize
/// selection in implicit Runge-Kutta methods", ACM TOMS 20 (1994) 496; Hairer, Wanner II, IV.8,
/// (8.25)). An error of 1 is allowed.
class PredictiveControl {
 public:
  /// The step after an accepted step of length h.
  double accept(double error, double h, double order, double safety, bool after_rejection) {
    double factor = next(error, order, safety);
    const double now = std::max(error, tuning::least_error);
    if (h_ > 0.0) {
      const double trend = h / h_ * std::pow(error_ / (now * now), 1.0 / order) * safety;
      factor = std::min(factor, std::max(trend, tuning::shortest));
    }
    h_ = h, error_ = now;
    return h * (after_rejection ? std::min(factor, 1.0) : factor);
  }
  /// The step after a rejected step of length h.
  static double reject(double error, double h, double order, double safety) {
    return h * std::min(next(error, order, safety), tuning::longest_retry);
  }
  /// The last step says nothing about the next.
  void forget() { h_ = 0.0; }

 private:
  static double next(double error, double order, double safety) {
    return std::clamp(safety * std::pow(std::max(error, tuning::no_error), -1.0 / order),
                      tuning::shortest, tuning::longest);
  }

  double h_ = 0.0, error_ = 0.0;  // of the last accepted step
};

/// The safety of a step size: the less, the more of the allowed iterations Newton took (IV.8, p.
/// 124).
inline double safety_of(int iterations, int most) {
  return tuning::safety * (1.0 + 2.0 * most) / (iterations + 2.0 * most);
}

/// Whether a step longer by this factor saves less than the factorisation that it costs (the code
/// RADAU5).
constexpr bool not_worth_it(double factor) { return factor >= 1.0 && factor < tuning::worth_it; }

/// The facts on which a choice of the order depends.
struct OrderFacts {
  int stages = 3;
  double theta = 0.0;  ///< contraction of Newton's iteration in the last steps
  double ratio = 1.0;  ///< of the lengths of the last two steps
  int steps = 0;       ///< accepted with these stages
  bool newton_failed = false;
  int usual = 3;  ///< see first_stages
  int highest = 7;
};

/// The usual number of stages. A run begins with it, and after a fall the order soon rises to it
/// again. Without it the order of a run would depend on its first steps. In a transient they are so
/// short that the order rises, and then it stays high. A run that begins on a smooth solution would
/// keep three stages: Van der Pol with mu = 1000 at rtol 1e-12 took ten times the steps.
constexpr int first_stages(double rtol) {
  return rtol <= tuning::begins_with_seven ? 7 : rtol <= tuning::begins_with_five ? 5 : 3;
}

/// The stages of the next step (Hairer, Wanner, J. Comput. Appl. Math. 111 (1999) 93, section 4):
///
///   Newton's iteration failed, or theta >= 0.8           fewer
///   theta <= 0.002 after ten steps of nearly one length  more; 0.02 below the usual number
///   otherwise                                            as many
inline int next_stages(const OrderFacts& facts) {
  if (facts.newton_failed || facts.theta >= tuning::falls_from)
    return std::max(facts.stages - 2, 3);
  const bool steady = facts.ratio > tuning::least_even && facts.ratio < tuning::most_even &&
                      facts.steps >= tuning::even_steps;
  const double enough = facts.stages < facts.usual ? tuning::returns_to : tuning::rises_to;
  return steady && facts.theta <= enough ? std::min(facts.stages + 2, facts.highest) : facts.stages;
}

}  // namespace saltus::radau
