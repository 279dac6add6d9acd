// Step sizes of the one-step methods: the first step, the next step, and the errors when no step is
// small enough.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

/// Proportional-integral control of the step size (K. Gustafsson; Hairer, Wanner II, p. 28,
/// (2.43c), safety 0.9; beta and the bounds of the factor come from the codes DOPRI5, the default
/// here, and DOP853).
class StepController {
 public:
  StepController(double order, double beta = 0.04, double shortest = 0.2, double longest = 10.0)
      : beta_(beta),
        shortest_(shortest),
        longest_(longest),
        exponent_(1.0 / order - 0.75 * beta),
        plain_(1.0 / order) {}

  double accept(double error, double h, bool after_rejection) {
    // Below 1e-9 both powers together exceed the longest factor, so log2 is not needed.
    const double size = error < 1e-9 ? tiny : std::log2(error);
    const double factor = error < 1e-9
                              ? longest_
                              : std::clamp(safety * std::exp2(beta_ * before_ - exponent_ * size),
                                           shortest_, longest_);
    before_ = std::max(size, tiny);
    return h * (after_rejection ? std::min(factor, 1.0) : factor);
  }
  /// The step after a rejection. The codes shorten to a tenth at most; after a change of mode a
  /// thousandth may be right, which an error of 1e10 shows.
  double reject(double error, double h) const {
    return h *
           (std::isfinite(error) ? std::clamp(safety * std::pow(error, -plain_), 1e-3, 0.9) : 0.1);
  }

 private:
  static constexpr double safety = 0.9;
  static constexpr double tiny = -13.287712379549449;  // log2(1e-4)
  double beta_, shortest_, longest_, exponent_, plain_;
  double before_ = tiny;  // log2 of the error of the last step
};

/// The first step, from the size of x, f and f' (Hairer, Norsett, Wanner I, p. 169, "Starting step
/// size"). The book's constants are in seconds; here the unit is the time in which x changes by
/// itself, or by a tolerance if x is smaller, so that another unit of time gives the same steps.
inline double first_step(Machine& machine, double t, const Eigen::VectorXd& x, const double* f,
                         Eigen::VectorXd& scratch, double* f1, const SolverOptions& options,
                         double order, double t_stop) {
  const Index n = x.size();
  const auto norm = [&](auto value) {
    double sum = 0.0;
    for (Index i = 0; i < n; ++i) {
      const double e = value(i) / options.tolerance(i, std::abs(x[i]));
      sum += e * e;
    }
    return n > 0 ? std::sqrt(sum / static_cast<double>(n)) : 0.0;
  };
  const double longest = std::min(t_stop - t, options.max_step);
  const double limit = std::isfinite(longest) ? longest : 1.0;  // no end, no other scale
  const double d0 = norm([&](Index i) { return x[i]; }), d1 = norm([&](Index i) { return f[i]; });
  const bool stands = d1 * limit < 1e-5;  // x hardly moves at this speed
  const double h0 = stands ? 1e-3 * limit : std::min(0.01 * std::max(d0, 1.0) / d1, limit);
  const double unit = 100.0 * h0;
  for (Index i = 0; i < n; ++i) scratch[i] = x[i] + h0 * f[i];
  machine.derivative(t + h0, scratch.data(), f1);
  const double d2 = norm([&](Index i) { return f1[i] - f[i]; }) / h0;
  // A component at zero is measured by atol alone and makes d1 look large: if x changes more slowly
  // by f', the time scale is from f'.
  const double whole = std::max(d0, 1.0), bend = d2 * unit * unit;
  const double clock = bend < whole ? std::sqrt(whole / d2) : unit;
  const double largest = std::max(d1 * unit, bend);
  const double h1 = largest <= 1e-15 ? unit : clock * std::pow(0.01 / largest, 1.0 / order);
  // The step is at least 100 roundings of the time, as CVODE's first step.
  const double shortest =
      100.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), limit);
  const double h = std::min(std::max(shortest, std::min(unit, h1)), limit);
  return std::isfinite(h) && h > 0.0 ? h : limit;
}

/// Throws for a value that is not finite at (t + ahead, x). The run is at t and cannot get there.
[[noreturn]] inline void throw_not_finite(Machine& machine, double t, const double* x,
                                          double ahead = 0.0) {
  const NotFinite found = machine.not_finite(t + ahead, x).value_or(NotFinite{});
  throw SimulationError(text("t = ", t, " s: ", found.what, " is not finite (NaN or Inf): ",
                             found.entry, "; check its equation and parameters at this state"),
                        t, found.block);
}

/// Throws if a derivative is not finite at (t, x), or just ahead on the flow, so that no step can
/// end there.
inline void require_finite_near(Machine& machine, double t, double h, const double* x) {
  const double ahead =
      std::max(16.0 * h, 64.0 * std::numeric_limits<double>::epsilon() * std::abs(t));
  const VectorView here(x, machine.plan().nx);
  Eigen::VectorXd there = here;
  if (machine.not_finite(t, x)) throw_not_finite(machine, t, x);
  if (machine.not_finite(t + ahead, x)) throw_not_finite(machine, t, x, ahead);
  machine.derivative(t, x, there.data());
  there = here + ahead * there;
  if (machine.not_finite(t + ahead, there.data()))
    throw_not_finite(machine, t, there.data(), ahead);
}

/// The tolerances, for messages.
inline std::string words_of_tolerances(const SolverOptions& options) {
  const auto words = [](const char* name, double all, const std::vector<double>& each) {
    if (each.empty()) return text(name, " = ", all);
    return text(name, " from ", all, " to ", *std::ranges::max_element(each));
  };
  return text(words("rtol", options.rtol, options.rtols), ", ",
              words("atol", options.atol, options.atols));
}

/// The block whose state moves fastest, in tolerances: the block in which a solution blows up.
inline std::string fastest_block(Machine& machine, double t, const double* x,
                                 const SolverOptions& options) {
  Eigen::VectorXd f(machine.plan().nx);
  machine.derivative(t, x, f.data());
  std::string block;
  double most = -1.0;
  for (const PlanLeaf& leaf : machine.plan().leaves) {
    for (Index i = leaf.x; i < leaf.x + leaf.nx; ++i) {
      const double speed = std::abs(f[i]) / options.tolerance(i, std::abs(x[i]));
      if (speed > most) most = speed, block = leaf.path;
    }
  }
  return block;
}

[[noreturn]] inline void throw_step_too_small(Machine& machine, double t, double h, const double* x,
                                              const SolverOptions& options) {
  require_finite_near(machine, t, h, x);
  const std::string block = fastest_block(machine, t, x, options);
  if (options.min_step > 0.0 && h <= 1.01 * options.min_step) {
    throw SimulationError(
        text("t = ", t, " s: the tolerance needs a step of ", h,
             " s, below min_minor_step_size = ", options.min_step,
             " s; lower that, or loosen rtol and atol; block '", block, "' moves fastest"),
        t, block);
  }
  throw SimulationError(
      text("t = ", t, " s: the step size underflows (", h,
           " s): the solution blows up in finite time, has a jump that no guard announces, or the "
           "tolerance cannot be met; block '",
           block, "' moves fastest; ", words_of_tolerances(options)),
      t, block);
}

}  // namespace saltus
