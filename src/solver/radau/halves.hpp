// A step taken again in two halves, for looks inside it.
#pragma once

#include "stage_solver.hpp"

namespace saltus::radau {

/// The collocation polynomial has the error h^(S + 1), the step h^(2 S): where the step is as long
/// as its own error allows, the polynomial is far off. Two halves have 2^-(S + 1) of its error.
/// They do not change the step, so recorded rows and monitors change no results.
class StageHalves {
 public:
  explicit StageHalves(Index n) : middle_(n), shift_(n), first_(n), second_(n) {}

  /// Solves both halves, from the polynomial of the step. False if that fails.
  bool solve(StageSolver& solver, double t0, const Eigen::VectorXd& x0, const Eigen::VectorXd& x1,
             double length, const StagePolynomial& whole) {
    const double h = 0.5 * length;
    const int stages = whole.stages;
    first_.stages = second_.stages = stages;
    whole.predict(stages, 0.0, 0.5, first_.z);
    if (!solver.solve_aside(t0, x0, h, first_)) return false;
    middle_ = x0 + first_.end();
    whole.predict(stages, 0.5, 0.5, second_.z);
    if (!solver.solve_aside(t0 + h, middle_, h, second_)) return false;
    shift_ = x1 - middle_ - second_.end();
    return shift_.allFinite();
  }

  /// The state at the part s of the step. The end of the second half differs from x1 by the error
  /// of the step, which is spread over it.
  void read(const double* x0, double s, double* x) const {
    if (s < 0.5)
      first_.read(x0, 2.0 * s, x);
    else
      second_.read(middle_.data(), 2.0 * s - 1.0, x);
    VectorRef(x, shift_.size()) += s * shift_;
  }

 private:
  Eigen::VectorXd middle_;  // the state between the halves
  Eigen::VectorXd shift_;   // from the end of the second half to x1
  StagePolynomial first_, second_;
};

}  // namespace saltus::radau
