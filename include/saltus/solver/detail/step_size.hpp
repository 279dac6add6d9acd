// Step sizes of the one-step methods: the first step, the next step, and the errors when no step is
// small enough.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"

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
        exponent_(1.0 / order - thresholds::beta_of_exponent * beta),
        plain_(1.0 / order) {}

  double accept(double error, double h, bool after_rejection) {
    const bool negligible = error < thresholds::negligible_error;
    const double size = negligible ? thresholds::least_remembered : std::log2(error);
    const double factor =
        negligible
            ? longest_
            : std::clamp(thresholds::step_safety * std::exp2(beta_ * before_ - exponent_ * size),
                         shortest_, longest_);
    before_ = std::max(size, thresholds::least_remembered);
    return h * (after_rejection ? std::min(factor, 1.0) : factor);
  }
  /// The step after a rejection, whose error is above 1.
  double reject(double error, double h) const {
    if (!std::isfinite(error)) return h * thresholds::blind_retry;
    return h *
           std::max(thresholds::step_safety * std::pow(error, -plain_), thresholds::shortest_retry);
  }

 private:
  double beta_, shortest_, longest_, exponent_, plain_;
  double before_ = thresholds::least_remembered;  // log2 of the error of the last step
};

/// The length of a step towards a stop, and whether it ends there.
struct StepLength {
  double h;  // [s]
  bool ends;
};

/// The length for a step that should be `wish` long, `left` before the stop: two equal steps are
/// better than a long step and a very short one.
inline StepLength fit(double wish, double left) {
  if (wish >= left) return {left, true};
  return {2.0 * wish > left ? 0.5 * left : wish, false};
}

/// Whether a step of this length can be told from none at this time, and is not below
/// min_minor_step_size.
inline bool has_room(double t, double h, const SolverOptions& options) {
  return h > thresholds::least_step_roundings * thresholds::eps * std::abs(t) &&
         h >= options.min_step;
}

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
  const bool rests = d1 * limit < thresholds::resting_change;  // x hardly moves at this speed
  const double h0 = rests ? thresholds::resting_step * limit
                          : std::min(thresholds::first_change * std::max(d0, 1.0) / d1, limit);
  const double unit = thresholds::time_of_change * h0;
  for (Index i = 0; i < n; ++i) scratch[i] = x[i] + h0 * f[i];
  machine.derivative(t + h0, scratch.data(), f1);
  const double d2 = norm([&](Index i) { return f1[i] - f[i]; }) / h0;
  // A component at zero is measured by atol alone and makes d1 look large: if x changes more slowly
  // by f', the time scale is from f'.
  const double whole = std::max(d0, 1.0), bend = d2 * unit * unit;
  const double clock = bend < whole ? std::sqrt(whole / d2) : unit;
  const double largest = std::max(d1 * unit, bend);
  // Infinite without slope and curvature.
  const double h1 = clock * std::pow(thresholds::first_change / largest, 1.0 / order);
  const double shortest =
      thresholds::first_step_roundings * thresholds::eps * std::max(std::abs(t), limit);
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
  const double ahead = std::max(thresholds::ahead_steps * h,
                                thresholds::ahead_roundings * thresholds::eps * std::abs(t));
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
  if (options.min_step > 0.0 && h <= thresholds::at_min_step * options.min_step) {
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
