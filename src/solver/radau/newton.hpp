// Newton's iteration for the stages of a step.
#pragma once

#include <cmath>

#include "saltus/solver/detail/radau/convergence.hpp"
#include "saltus/solver/detail/radau/residual.hpp"
#include "saltus/solver/detail/radau/stage_polynomial.hpp"
#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"
#include "stage_systems.hpp"

namespace saltus::radau {

/// Solves z = h (A x I) f(t0 + c h, x0 + z) by simplified Newton iterations. With r = h (A x I) f -
/// z each is (Lambda - h J) d = Lambda (T^-1 x I) r, z += (T x I) d, which falls into systems for
/// each eigenvalue (Hairer, Wanner II, IV.8, (8.6) to (8.13), times h).
///
/// The residual r is taken before it is transformed. If its two parts were transformed one by one,
/// their roundings would grow by |T| |T^-1|, up to 1e3, and break the linear invariants of f.
class Newton {
 public:
  Newton(Machine& machine, const SolverOptions& options)
      : machine_(&machine),
        options_(options),
        n_(machine.plan().nx),
        x_(n_),
        tolerance_(n_),
        r_(n_, most_stages),
        f_(n_, most_stages),
        d_(n_, most_stages) {}

  struct Problem {
    double t0, h;
    const double* x0;
    double allowed;  // [tolerances] of the iteration
    double factor;   // see Convergence
  };

  /// `polynomial` has the number of stages and their first values, and gets the solution. Verdict
  /// `diverged` also if a derivative is not finite: `finite` then returns false.
  Verdict solve(const Problem& problem, StageSystems& systems, StagePolynomial& polynomial) {
    if (polynomial.stages == 3) return iterate<3>(problem, systems, polynomial.z);
    if (polynomial.stages == 5) return iterate<5>(problem, systems, polynomial.z);
    return iterate<7>(problem, systems, polynomial.z);
  }
  const Convergence& convergence() const { return convergence_; }
  bool finite() const { return finite_; }

 private:
  template <int S>
  using Block = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, S>>;

  template <int S>
  Verdict iterate(const Problem& problem, StageSystems& systems, Eigen::MatrixXd& stages) {
    Block<S> z(stages.data(), n_, S);
    convergence_ = {problem.allowed, rounding(), most_iterations(S), problem.factor};
    for (Index i = 0; i < n_; ++i)
      tolerance_[i] = 1.0 / options_.tolerance(i, std::abs(problem.x0[i]));
    for (;;) {
      const double size = correct<S>(problem, systems, z);
      if (finite_ = std::isfinite(size); !finite_) return Verdict::diverged;
      const Verdict verdict = convergence_.look(size);
      if (verdict == Verdict::go_on) continue;
      const bool doubtful =
          convergence_.at_rounding() || (size == 0.0 && !residual<S>().isZero(0.0));
      if (verdict == Verdict::converged && doubtful && !is_rounding<S>(problem, z))
        return Verdict::diverged;
      return verdict;
    }
  }

  template <int S>
  Block<S> residual() {
    return Block<S>(r_.data(), n_, S);
  }

  /// Whether rounding explains the residual of the last stage, z_S - h sum_j a_Sj f_j. If the
  /// Jacobian has a difference across a jump of f, or is wrong, all corrections are small, whatever
  /// the residual. The rounding of f is seen by a relative change of the states.
  template <int S>
  bool is_rounding(const Problem& problem, const Block<S>& z) {
    Block<S> f(f_.data(), n_, S);
    evaluate<S>(problem, z, f);
    auto residual = d_.col(0);
    residual = z.col(S - 1);
    for (int j = 0; j < S; ++j) residual -= problem.h * RadauTable<S>::a[S - 1][j] * f.col(j);
    if (residual.cwiseProduct(tolerance_).norm() <= problem.allowed) return true;
    for (Index i = 0; i < n_; ++i) x_[i] = slightly_changed(problem.x0[i] + z(i, S - 1));
    auto moved = d_.col(1);
    machine_->derivative(problem.t0 + problem.h, x_.data(), &d_(0, 1));
    for (Index i = 0; i < n_; ++i) {
      if (!rounding_explains(residual[i], x_[i], problem.h, f(i, S - 1), moved[i])) return false;
    }
    return true;
  }

  template <int S>
  void evaluate(const Problem& problem, const Block<S>& z, Block<S>& f) {
    for (int j = 0; j < S; ++j) {
      for (Index i = 0; i < n_; ++i) x_[i] = problem.x0[i] + z(i, j);
      machine_->derivative(problem.t0 + RadauTable<S>::c[j] * problem.h, x_.data(), &f(0, j));
    }
  }

  /// One iteration. Returns the root mean square of the correction of z [tolerances].
  template <int S>
  double correct(const Problem& problem, StageSystems& systems, Block<S>& z) {
    Block<S> f(f_.data(), n_, S), r = residual<S>(), d(d_.data(), n_, S);
    evaluate<S>(problem, z, f);
    r = f.lazyProduct(matrix<S>(RadauTable<S>::a).transpose());
    r = problem.h * r - z;
    d = r.lazyProduct(matrix<S>(RadauTable<S>::t_inverse).transpose());
    multiply<S>(d);
    systems.solve_real(d.data());
    for (int k = 0; k < (S - 1) / 2; ++k) systems.solve_pair(k, &d(0, 2 * k + 1), &d(0, 2 * k + 2));
    f = d.lazyProduct(matrix<S>(RadauTable<S>::t).transpose());
    z += f;
    double sum = 0.0;
    for (int j = 0; j < S; ++j) {
      for (Index i = 0; i < n_; ++i) {
        const double e = f(i, j) * tolerance_[i];
        sum += e * e;
      }
    }
    return std::sqrt(sum / static_cast<double>(S * n_));
  }

  /// d becomes Lambda d.
  template <int S>
  void multiply(Block<S>& d) {
    using Table = RadauTable<S>;
    d.col(0) *= Table::gamma;
    for (int k = 0; k < (S - 1) / 2; ++k) {
      const double alpha = Table::alpha[k], beta = Table::beta[k];
      double *re = &d(0, 2 * k + 1), *im = &d(0, 2 * k + 2);
      for (Index i = 0; i < n_; ++i) {
        const double part = re[i];
        re[i] = alpha * part - beta * im[i];
        im[i] = beta * part + alpha * im[i];
      }
    }
  }

  template <int S>
  static auto matrix(const double (&values)[S][S]) {
    return Eigen::Map<const Eigen::Matrix<double, S, S, Eigen::RowMajor>>(&values[0][0]);
  }
  /// [tolerances] Some roundings of the states, which are at least rtol of their size.
  double rounding() const { return rounding_of(options_.rtol); }

  Machine* machine_;
  SolverOptions options_;
  Index n_;
  Eigen::VectorXd x_, tolerance_;
  Eigen::MatrixXd r_, f_, d_;
  Convergence convergence_{1.0, 0.0, 1, 1.0};
  bool finite_ = true;
};

}  // namespace saltus::radau
