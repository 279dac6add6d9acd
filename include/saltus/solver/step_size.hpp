// Step sizes of the one-step methods: the first one, the next one, the stiffness test, and what to
// say when none is small enough.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/solver/solver.hpp"

namespace saltus {

/// Proportional-integral control of the step size (K. Gustafsson; Hairer, Wanner II, p. 28,
/// (2.43c), safety 0.9; beta and the bounds of the factor are those of the codes DOPRI5, the
/// default here, and DOP853).
class StepController {
 public:
  StepController(double order, double beta = 0.04, double shortest = 0.2, double longest = 10.0)
      : beta_(beta),
        shortest_(shortest),
        longest_(longest),
        exponent_(1.0 / order - 0.75 * beta),
        plain_(1.0 / order) {}

  double accept(double error, double h, bool after_rejection) {
    // Below 1e-9 both powers together exceed the longest factor: no need to ask.
    const double factor =
        error < 1e-9 ? longest_
                     : std::clamp(safety * std::pow(error, -exponent_) * std::pow(before_, beta_),
                                  shortest_, longest_);
    before_ = std::max(error, 1e-4);
    return h * (after_rejection ? std::min(factor, 1.0) : factor);
  }
  double reject(double error, double h) const {
    return h *
           (std::isfinite(error) ? std::clamp(safety * std::pow(error, -plain_), 0.1, 0.9) : 0.1);
  }

 private:
  static constexpr double safety = 0.9;
  double beta_, shortest_, longest_, exponent_, plain_, before_ = 1e-4;
};

/// Stiffness by comparing h with the stability region: h |f(x1) - f(X)| / |x1 - X|, X the argument
/// of the last stage but one, also at t + h, estimates h |lambda|, which lies beyond `stability`
/// when that bounds the step (L. F. Shampine; Hairer, Wanner II, p. 21, (2.33)). Fifteen such
/// steps, with no more than five other ones in a row between, are called stiff.
class StiffnessTest {
 public:
  explicit StiffnessTest(double stability) : square_(stability * stability) {}

  bool detected() const noexcept { return stiff_ >= 15; }
  void forget() noexcept { stiff_ = calm_ = 0; }

  template <class Stepper>
  void look(Stepper& s, double h, double error) {
    if (error > 1.0) return;
    const double *f0 = s.stage(s.last - 1), *f1 = s.stage(s.last);
    double numerator = 0.0, denominator = 0.0;
    const double *x1 = s.x1_.data(), *x0 = s.scratch_.data();  // scratch: what stage last - 1 read
    for (Index i = 0, n = s.n_; i < n; ++i) {
      const double f = f1[i] - f0[i], x = x1[i] - x0[i];
      numerator += f * f, denominator += x * x;
    }
    // Compared without division or root: h^2 f^2 > stability^2 x^2.
    if (denominator > 0.0 && h * h * numerator > square_ * denominator) {
      ++stiff_, calm_ = 0;
    } else if (++calm_ == 6) {
      stiff_ = 0;
    }
  }

 private:
  double square_;
  int stiff_ = 0, calm_ = 0;
};

/// First step by the size of x, f and f' (Hairer, Norsett, Wanner I, p. 169, "Starting step size").
inline double first_step(Machine& machine, double t, const Eigen::VectorXd& x, const double* f,
                         Eigen::VectorXd& scratch, double* f1, const SolverOptions& options,
                         double order, double t_stop) {
  const Index n = x.size();
  const auto norm = [&](auto value) {
    double sum = 0.0;
    for (Index i = 0; i < n; ++i) {
      const double e = value(i) / (options.atol + options.rtol * std::abs(x[i]));
      sum += e * e;
    }
    return n > 0 ? std::sqrt(sum / static_cast<double>(n)) : 0.0;
  };
  const double limit = std::min(t_stop - t, options.max_step);
  const double d0 = norm([&](Index i) { return x[i]; }), d1 = norm([&](Index i) { return f[i]; });
  const double h0 = std::min(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1, limit);
  for (Index i = 0; i < n; ++i) scratch[i] = x[i] + h0 * f[i];
  machine.derivative(t + h0, scratch.data(), f1);
  const double d2 = norm([&](Index i) { return f1[i] - f[i]; }) / h0;
  const double largest = std::max(d1, d2);
  const double h1 =
      largest <= 1e-15 ? std::max(1e-6, h0 * 1e-3) : std::pow(0.01 / largest, 1.0 / order);
  const double h = std::min({100.0 * h0, h1, limit});
  return std::isfinite(h) && h > 0.0 ? h : h0;
}

[[noreturn]] inline void throw_not_finite(Machine& machine, double t, const double* x) {
  const std::string block = machine.not_finite(t, x);
  throw SimulationError(
      text("t = ", t, " s: the derivative of block '", block,
           "' is not finite (NaN or Inf); check its equation and parameters at this state"),
      t, block);
}

/// Throws if a derivative is not finite at (t, x), or just behind t, where no step could end.
inline void require_finite_near(Machine& machine, double t, double h, const double* x) {
  for (const double ahead :
       {0.0, std::max(16.0 * h, 64.0 * std::numeric_limits<double>::epsilon() * std::abs(t))}) {
    if (!machine.not_finite(t + ahead, x).empty()) throw_not_finite(machine, t + ahead, x);
  }
}

[[noreturn]] inline void throw_step_too_small(Machine& machine, double t, double h, const double* x,
                                              const SolverOptions& options) {
  require_finite_near(machine, t, h, x);
  if (options.min_step > 0.0 && h <= options.min_step) {
    throw SimulationError(text("t = ", t, " s: the tolerance needs a step of ", h,
                               " s, below min_minor_step_size = ", options.min_step,
                               " s; lower that, or loosen rtol and atol"),
                          t);
  }
  throw SimulationError(
      text("t = ", t, " s: the step size underflows (", h,
           " s): the solution blows up in finite time, has a jump that no guard announces, or the "
           "tolerance cannot be met; rtol = ",
           options.rtol, ", atol = ", options.atol),
      t);
}

}  // namespace saltus
