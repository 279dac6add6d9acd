// The error estimate of a step.
#pragma once

#include <array>
#include <limits>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/radau/allowed_estimate.hpp"
#include "stage_solver.hpp"

namespace saltus::radau {

/// The embedded formula (gamma - h J)^-1 (h f0 + sum_j e_j z_j) (Hairer, Wanner II, IV.8, (8.19)).
/// It is not filtered a second time where it is large at a start, as (8.20) does: a transient that
/// is damped within the step leaves no error at its end, but the collocation polynomial is wrong
/// inside.
class ErrorEstimate {
 public:
  ErrorEstimate(Index n, const SolverOptions& options)
      : options_(options), estimate_(n), plain_(n), before_(n), tolerance_(n) {
    for (std::size_t k = 0; k < allowed_.size(); ++k)
      allowed_[k].emplace(scheme_of(stage_counts[k]), options.rtol, thresholds::dense_room);
  }

  /// Another step begins, or the same one with other stages: no try of it is known.
  void forget_tries() { tried_ = 0.0; }
  /// A step was accepted: the next one is compared with it. A jump is not compared with.
  void accept(double h, int stages) { accepted_ = {size_, h, stages}; }
  void forget_steps() { accepted_ = {}; }

  /// Root mean square of the estimate, in allowed errors: infinite if it is not finite. `x1` is
  /// the end of the step.
  double look(StageSolver& solver, const Step& step, const StagePolynomial& stages,
              const Eigen::VectorXd& x1) {
    const Scheme scheme = scheme_of(stages.stages);
    before_.swap(estimate_);
    estimate_ = step.h * *step.f;
    for (int j = 0; j < stages.stages; ++j) estimate_ += scheme.e[j] * stages.z.col(j);
    plain_ = estimate_ / scheme.gamma;  // the part that a filter without J leaves
    solver.filter(estimate_);
    for (Index i = 0; i < estimate_.size(); ++i)
      tolerance_[i] = options_.tolerance(i, std::max(std::abs((*step.x)[i]), std::abs(x1[i])));
    size_ = mean(estimate_);
    const bool sudden =
        tried_ == 0.0 && accepted_.stages == scheme.stages &&
        is_sudden(size_, accepted_.size, step.h / accepted_.h, scheme.estimate_order());
    const double error = sudden ? size_ / allowed(scheme, x1).of(0.0)
                                : in_allowed(allowed(scheme, x1), step.h, scheme.stages);
    tried_ = step.h;
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
  }

  /// [tolerances] Root mean square of the last estimate.
  double size() const { return size_; }
  /// [tolerances] The largest part of it.
  double largest() const { return estimate_.cwiseQuotient(tolerance_).cwiseAbs().maxCoeff(); }
  /// Sets the error of a step that is accepted without an estimate.
  void set_size(double size) { size_ = size; }

 private:
  /// The error that is allowed at rtol, or, where the absolute tolerances are the larger part, at
  /// the ratio of the tolerances to the states.
  AllowedEstimate allowed(const Scheme& scheme, const Eigen::VectorXd& x1) const {
    const double relative = relative_tolerance(options_.rtol, mean(x1));
    if (relative > options_.rtol) return AllowedEstimate(scheme, relative, thresholds::dense_room);
    return *nth(allowed_, scheme.pairs() - 1);
  }

  /// Root mean square in allowed errors. `plain_` is overwritten.
  double in_allowed(const AllowedEstimate& allowed, double h, int stages) {
    const bool again = h < tuning::alike_tries * tried_;
    const double ratio = again ? h / tried_ : 1.0, shrunk = std::pow(ratio, stages);
    for (Index i = 0; i < estimate_.size(); ++i) {
      const double plain = std::abs(plain_[i]), left = std::abs(estimate_[i]);
      const double share = left < plain ? left / plain : 1.0;
      double own = estimate_[i], slow = share;
      if (again) {
        // The estimate of a fast part hardly shrinks anyway, so it shows nothing.
        slow *= 1.0 - share * (1.0 - shown_order(before_[i], estimate_[i], ratio, stages + 1.0));
        const double bound = thresholds::dense_room * tolerance_[i];
        own -= (1.0 - share) * inherited_estimate(before_[i], estimate_[i], shrunk, bound);
      }
      plain_[i] = own / allowed.of(slow);
    }
    return mean(plain_);
  }

  double mean(const Eigen::VectorXd& v) const {
    return std::sqrt(v.cwiseQuotient(tolerance_).squaredNorm() / static_cast<double>(v.size()));
  }

  SolverOptions options_;
  std::array<std::optional<AllowedEstimate>, stage_counts.size()> allowed_;
  Eigen::VectorXd estimate_, plain_, before_, tolerance_;
  double tried_ = 0.0;  // [s] length of the try before; 0: none
  struct {
    double size = 0.0, h = 1.0;  // [tolerances], [s]
    int stages = 0;              // 0: none
  } accepted_;                   // the last step
  double size_ = 0.0;
};

}  // namespace saltus::radau
