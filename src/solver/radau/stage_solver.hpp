// Solves the stages of a step, and decides when a Jacobian and a factorisation serve again.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "newton.hpp"

namespace saltus::radau {

/// A step to solve: its begin, the derivative there, and its length.
struct Step {
  double t;                  // [s]
  const Eigen::VectorXd* x;  // at t
  const Eigen::VectorXd* f;  // at (t, x)
  double h;                  // [s]
};

/// The Jacobian of a step is kept for the next ones until Newton's iteration contracts slowly with
/// it, across restarts too if it explains f there; the factorisation as long as the length of the
/// step stays. One that is much too large cannot be seen by the iteration: all corrections are
/// small, and so is the estimate of the error.
class StageSolver {
 public:
  StageSolver(Machine& machine, const SolverOptions& options)
      : machine_(&machine), options_(options), newton_(machine, options) {}

  /// A new run: nothing is known.
  void forget() { structure_.reset(), doubts_ = 0; }
  /// Makes the structure of the linear systems at the first step. Throws NoFactors if they cannot
  /// be factorised.
  void prepare(double t, const Eigen::VectorXd& x);
  /// The last iterations of Newton's method say nothing about the next step.
  void distrust() { factor_ = infinite; }
  /// The state has jumped: the Jacobian serves only if it explains how f moves there.
  void jump() { distrust(), jumped_ = true; }

  /// Solves the stages of a step from their first values, which `start` writes to the polynomial.
  /// False if Newton's iteration does not converge with a new Jacobian either: `shorter()` then is
  /// a factor for the length.
  template <class Start>
  bool solve(const Step& step, StagePolynomial& stages, const Start& start);
  double shorter() const { return shorter_; }
  /// Whether all derivatives were finite in the last iteration.
  bool finite() const { return newton_.finite(); }
  const Convergence& convergence() const { return newton_.convergence(); }
  /// The step of length h was accepted: decides whether the Jacobian is kept. Returns whether it
  /// is.
  bool keep(double h);
  void renew_jacobian() { known_ = false; }

  /// Solves the stages of a part of the last step from the first values they have.
  bool solve_aside(double t, const Eigen::VectorXd& x, double h, StagePolynomial& stages);
  /// v becomes (gamma - h J)^-1 v, of the last step.
  void filter(Eigen::VectorXd& v) { systems_->solve_real(v.data()); }

  long setups() const { return setups_; }
  const std::string& describe() const {
    static const std::string none;
    return structure_ ? structure_->describe() : none;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Throws NoFactors if the systems cannot be factorised.
  void use_structure(double t);
  bool make_jacobian(const Step& step);
  /// Whether the Jacobian of before a jump serves after it. A small one is made anew: that costs no
  /// more than the question.
  bool serves_after_jump(const Step& step);
  bool set_up(StageSystems& systems, const Scheme& scheme, double h);
  /// Whether the step may be tried again, with a new Jacobian or structure.
  bool recover(Verdict verdict, const Step& step);
  /// Whether the leaves' own Jacobians are found wrong, and differences will take their place.
  bool doubt(const Step& step);
  /// [tolerances] The error that Newton's iteration may leave.
  double room() const { return newton_room(options_.rtol); }

  Machine* machine_;
  SolverOptions options_;
  Newton newton_;
  std::optional<LinearStructure> structure_;
  std::optional<StageSystems> systems_, aside_;
  std::vector<double> jacobian_;  // in the layout of the structure
  bool known_ = false;            // the Jacobian serves
  bool jumped_ = false;           // since it was made
  int age_ = 0;                   // [steps] of the Jacobian
  int doubts_ = 0;                // failures with a new Jacobian, less the steps without
  bool failed_ = false;           // in this step, with a new Jacobian
  double factor_ = infinite;      // see Convergence
  double length_ = 0.0;           // [s] of the step that it is from
  double shorter_ = tuning::diverged_retry;
  long setups_ = 0;
};

template <class Start>
bool StageSolver::solve(const Step& step, StagePolynomial& stages, const Start& start) {
  shorter_ = tuning::diverged_retry;
  for (;;) {
    const Scheme scheme = scheme_of(stages.stages);
    if (std::exchange(jumped_, false)) known_ = known_ && serves_after_jump(step);
    if (!known_ && !make_jacobian(step)) return false;
    if (!systems_->serves(scheme, step.h) && !set_up(*systems_, scheme, step.h)) return false;
    start();
    const double before = scaled(factor_, step.h / length_);
    const Verdict verdict =
        newton_.solve({step.t, step.h, step.x->data(), room(), before}, *systems_, stages);
    if (verdict == Verdict::converged) return true;
    distrust();
    if (!recover(verdict, step)) return false;
  }
}

}  // namespace saltus::radau
