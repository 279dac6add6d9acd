// The stepper of the Radau methods: length and order of steps, looks inside them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "error_estimate.hpp"
#include "halves.hpp"
#include "saltus/solver/detail/radau/damping.hpp"
#include "saltus/solver/detail/radau/step_choice.hpp"
#include "saltus/solver/detail/step_solver.hpp"
#include "stage_solver.hpp"

namespace saltus::radau {

class RadauSolver final : public StepSolver<RadauSolver> {
 public:
  RadauSolver(Machine& machine, GuardSet& guards, const SolverOptions& options);

  // inside_step.cpp
  void inside_step(double u, double* x);
  double joint() override;
  /// See StepSolver.
  bool cut(double root);

  int degree() const override { return step_.stages; }
  std::string method() const override { return "radau"; }
  const SolverStatistics& statistics() const override;

 private:
  friend StepSolver<RadauSolver>;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  // --- one accepted step: solver.cpp

  void begin(const Start& start);
  void undo();
  void forget_steps();
  /// Tries steps until one is accepted.
  void step(double t_stop);
  void prepare_step(double t_stop);
  double careful_step(double t_stop);
  /// The first values of the stages: the polynomial of the last step goes on.
  void predict(double h);
  /// Sets the end of a step of length h from its stages.
  void finish_stages(double h);
  void accept(double error, double h, double wish, bool rejected);
  /// The next step damps the oscillation further, or is free.
  void go_on_damping(double h);
  Scheme scheme() const { return scheme_of(step_.stages); }

  // --- whether a try is good enough, and the next try if it is not: tries.cpp

  /// The error of a step of length h, in allowed errors. A step that damps may have more.
  double judged(double h);
  double estimate(double h);
  /// Whether the derivative is finite at the end of the step, where Newton's iteration has not seen
  /// it. It is the derivative at the begin of the next step.
  bool ends_finite();
  // The length of the next try, if Newton's iteration did not converge, a value was not finite, or
  // the error was too large.
  double retry_after_failure(double h);
  double retry_after_jump(double h);
  double retry_after_error(double error, double h, bool rejected, double t_stop);
  /// Takes the step along the derivative if that moves no state by a tolerance, nor does one at a
  /// stage, and the derivative jumps: there Newton's iteration may not converge, however short the
  /// step is. Without steps a solution that slides along a jump would not be noticed.
  bool creep(double h);
  /// The lengths of the next steps are then no trend of the error.
  void note_not_finite(double h);
  void require_room(double h);

  // --- looks inside a step: inside_step.cpp

  /// [tolerances] Of the collocation polynomial inside the step.
  double dense_error() const { return error_.size() * scheme().dense_share; }
  void look_inside();

  template <class Vector>
  double in_tolerances(const Vector& v) const {
    double sum = 0.0;
    for (Index i = 0; i < n_; ++i) {
      const double e = v[i] / options_.tolerance(i, std::max(std::abs(x0_[i]), std::abs(x1_[i])));
      sum += e * e;
    }
    return std::sqrt(sum / static_cast<double>(n_));
  }

  Eigen::VectorXd x0_, f0_;  // at the begin of the step
  Eigen::VectorXd f1_;       // at its end
  Eigen::VectorXd residual_, scratch_;
  StageSolver stages_;
  StagePolynomial step_, last_;  // of the present step, and of the step before
  /// The looks inside the step: by its polynomial, or by those of two halves.
  struct Inside {
    StageHalves halves;
    bool known = false, halved = false;
  } inside_;
  ErrorEstimate error_;
  bool f1_known_ = false;
  Damping damping_;
  bool smooth_ = false;  // the solution of the last step continues in the present one
  double h_ = 0.0, horizon_ = infinite, last_length_ = 0.0;
  double not_finite_within_ = 0.0;  // [s] of the present step; 0: all values were finite
  StepChoice choice_{options_.rtol};
  long setups_before_ = 0;  // of earlier runs
  mutable SolverStatistics sum_;
};

}  // namespace saltus::radau
