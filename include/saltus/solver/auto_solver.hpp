// AutoSolver: the one-step method first, BDF where the scene proves stiff.
#pragma once

#include <memory>
#include <string>

#include "saltus/solver/cvode.hpp"
#include "saltus/solver/one_step.hpp"

namespace saltus {

/// Starts with dopri5; when that looks stiff, BDF takes over at the present point. CVODE is made
/// only then.
class AutoSolver final : public Solver {
 public:
  AutoSolver(Machine& machine, Watch& watch, const SolverOptions& options)
      : machine_(&machine), watch_(&watch), options_(options), first_(machine, watch, options) {}

  void restart(double t, const Eigen::VectorXd& x, const Start& start) override {
    if (start.first) second_.reset();
    now().restart(t, x, start);
  }

  StopReason advance(double t_stop) override {
    if (!second_ && first_.looks_stiff()) {
      switched_at_ = first_.time();
      second_ = make_cvode(*machine_, *watch_, options_, CvodeMethod::bdf);
      second_->restart(first_.time(), first_.state(), {.first = true});
    }
    return now().advance(t_stop);
  }

  void interpolate(double t, double* x) override { now().interpolate(t, x); }
  const std::vector<Firing>& roots() const override { return watch_->fired; }
  double time() const override { return now().time(); }
  const Eigen::VectorXd& state() const override { return now().state(); }

  const SolverStatistics& statistics() const override {
    sum_ = first_.statistics();
    if (second_) {
      const SolverStatistics& more = second_->statistics();
      sum_.steps += more.steps, sum_.rejected += more.rejected;
      sum_.restarts += more.restarts, sum_.linear_setups += more.linear_setups;
    }
    return sum_;
  }

  std::string method() const override {
    return second_ ? text("dopri5, then bdf from t = ", switched_at_, " s: the scene looks stiff")
                   : std::string("dopri5");
  }

 private:
  Solver& now() { return second_ ? *second_ : first_; }
  const Solver& now() const { return second_ ? static_cast<const Solver&>(*second_) : first_; }

  Machine* machine_;
  Watch* watch_;
  SolverOptions options_;
  RungeKutta<Dopri5> first_;
  std::unique_ptr<Solver> second_;
  double switched_at_ = 0.0;
  mutable SolverStatistics sum_;
};

}  // namespace saltus
