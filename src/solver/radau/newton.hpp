// Newton's iteration for the stages of a step.
#pragma once

#include <cmath>

#include "convergence.hpp"
#include "saltus/solver/detail/solver.hpp"
#include "stage_polynomial.hpp"
#include "stage_systems.hpp"

namespace saltus::radau {

/// Solves z = h (A x I) f(t0 + c h, x0 + z) by simplified Newton iterations. With w = (T^-1 x I) z
/// each iteration is (Lambda / h - J) dw = (T^-1 x I) f - Lambda / h w, which falls into systems for
/// each eigenvalue (Hairer, Wanner II, IV.8, (8.6) to (8.13)).
class Newton {
 public:
  Newton(Machine& machine, const SolverOptions& options)
      : machine_(&machine),
        options_(options),
        n_(machine.plan().nx),
        x_(n_),
        tolerance_(n_),
        w_(n_, most_stages),
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
    Block<S> z(stages.data(), n_, S), w(w_.data(), n_, S);
    convergence_ = {problem.allowed, most_iterations(S), problem.factor};
    for (Index i = 0; i < n_; ++i)
      tolerance_[i] = 1.0 / options_.tolerance(i, std::abs(problem.x0[i]));
    w = z.lazyProduct(matrix<S>(RadauTable<S>::t_inverse).transpose());
    for (;;) {
      const double size = correct<S>(problem, systems, z, w);
      if (finite_ = std::isfinite(size); !finite_) return Verdict::diverged;
      const Verdict verdict = convergence_.look(size);
      if (verdict != Verdict::go_on) return verdict;
    }
  }

  /// One iteration. Returns the root mean square of the correction of z [tolerances].
  template <int S>
  double correct(const Problem& problem, StageSystems& systems, Block<S>& z, Block<S>& w) {
    Block<S> f(f_.data(), n_, S), d(d_.data(), n_, S);
    for (int j = 0; j < S; ++j) {
      for (Index i = 0; i < n_; ++i) x_[i] = problem.x0[i] + z(i, j);
      machine_->derivative(problem.t0 + RadauTable<S>::c[j] * problem.h, x_.data(), &f(0, j));
    }
    d = f.lazyProduct(matrix<S>(RadauTable<S>::t_inverse).transpose());
    subtract_scaled<S>(w, problem.h, d);
    systems.solve_real(d.data());
    for (int k = 0; k < (S - 1) / 2; ++k)
      systems.solve_pair(k, &d(0, 2 * k + 1), &d(0, 2 * k + 2));
    w += d;
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

  /// d -= Lambda / h w.
  template <int S>
  void subtract_scaled(const Block<S>& w, double h, Block<S>& d) {
    using Table = RadauTable<S>;
    d.col(0) -= Table::gamma / h * w.col(0);
    for (int k = 0; k < (S - 1) / 2; ++k) {
      const double alpha = Table::alpha[k] / h, beta = Table::beta[k] / h;
      const int re = 2 * k + 1, im = re + 1;
      d.col(re) -= alpha * w.col(re) - beta * w.col(im);
      d.col(im) -= beta * w.col(re) + alpha * w.col(im);
    }
  }

  template <int S>
  static auto matrix(const double (&values)[S][S]) {
    return Eigen::Map<const Eigen::Matrix<double, S, S, Eigen::RowMajor>>(&values[0][0]);
  }
  /// 7, 12 and 17 (the code RADAU).
  static constexpr int most_iterations(int stages) { return 7 + 5 * (stages - 3) / 2; }

  Machine* machine_;
  SolverOptions options_;
  Index n_;
  Eigen::VectorXd x_, tolerance_;
  Eigen::MatrixXd w_, f_, d_;
  Convergence convergence_{1.0, 1, 1.0};
  bool finite_ = true;
};

}  // namespace saltus::radau
