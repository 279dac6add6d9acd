// Stiffness for an explicit method: whether stability, not the solution, bounds the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/stiff_thresholds.hpp"

namespace saltus {

/// The numbers of a method that the test needs.
struct StabilityBounds {
  double real;  ///< h |lambda| beyond which stability bounds the step, on the negative real axis
  double imaginary;  ///< the same on the imaginary axis
  double amplitude;  ///< [tolerances] of an oscillation whose steps there have an error of 1
};

/// Tests for three signs of stiffness, from values that a step computes anyway.
///
/// h |f(x1) - f(X)| / |x1 - X| estimates h |lambda|; X is the argument of the last stage but one,
/// also at t + h. Beyond `stability` it bounds the step (L. F. Shampine; Hairer, Wanner II, p. 21,
/// (2.33)).
///
/// At tight tolerances an explicit method keeps h |lambda| well below that, and its steps are still
/// short: its error estimate contains powers of h lambda although the solution is smooth
/// (Robertson, rtol 1e-12: h |lambda| = 0.35 with dopri5, for 10^5 steps). So a step is also called
/// stiff if a comparison of the families by L. Petzold's rule ("Automatic selection of methods for
/// solving stiff and nonstiff systems of ordinary differential equations", SIAM J. Sci. Stat.
/// Comput. 4 (1983) 136: by the step each could take) favours BDF: the derivative changes in a step
/// by a part r = |f1 - f0| / |f| only, the Jacobian by more than ten times that, and BDF, whose
/// step on a smooth solution was measured as 0.4 rtol^(1/6) h / r (two modes of bench/methods, rtol
/// 1e-3 to 1e-12) at a call and a half, would need less than half of our calls.
///
/// The scene is called stiff after fifteen such steps, with at most five other steps in a row
/// between them.
///
/// On the imaginary axis stability bounds the steps at h |lambda| = 1 already with dopri5. A fast
/// mode that the solution does not excite is then excited by the errors, up to as many tolerances
/// as the error estimate lets pass: some hundred with dopri5. An oscillation of the solution itself
/// is larger, up to 1 / rtol tolerances, and accuracy keeps its steps shorter. One step tells h
/// |lambda| of an oscillation to a factor only, which depends on the phase. So fifteen steps that
/// may be at the bound, counted in the same way, ask for a better value of |lambda|; with it the
/// size of the oscillation decides.
class StiffnessTest {
 public:
  /// `calls`: calls of the right-hand side in a step.
  StiffnessTest(const StabilityBounds& bounds, double calls, const SolverOptions& options)
      : stability_(bounds.real),
        turning_(bounds.imaginary),
        amplitude_(std::min(bounds.amplitude, thresholds::part_of_solution / options.rtol)),
        smooth_(thresholds::saved_calls * calls / thresholds::bdf_calls * thresholds::bdf_step *
                std::pow(options.rtol, 1.0 / 6.0)),
        options_(options) {}

  bool detected() const noexcept { return stiff_ >= thresholds::stiff_steps; }
  /// |lambda| [1/s] of the fastest part, as the last step has shown it; 0 before a step.
  double rate() const noexcept { return rate_; }
  /// At a restart, and at the begin of a run.
  void forget(bool run) noexcept {
    stiff_ = not_stiff_ = smooth_steps_ = 0, rate_ = 0.0;
    if (run) wanted_ = thresholds::stiff_steps;
    watch_anew();
  }

  /// Whether a fast oscillation may bound the steps by stability.
  bool may_oscillate() const noexcept { return long_ >= wanted_; }
  /// Whether it does, if its rate is |lambda| [1/s]: by the mean of the steps since the first of
  /// them, and by the mean change of the derivative in them.
  bool oscillates(double rate) const noexcept {
    return rate * span_ > turning_ * looks_ && amplitude(rate) < amplitude_;
  }
  /// [tolerances] The amplitude of an oscillation of this rate [1/s], by the mean change of the
  /// derivative; infinite if no step may have followed one.
  double amplitude(double rate) const noexcept {
    return long_ > 0 ? swing_ / (rate * long_) : std::numeric_limits<double>::infinity();
  }
  /// Whether Petzold's rule called most of the stiff steps so. It does not depend on a phase.
  bool by_smoothness() const noexcept { return 2 * smooth_steps_ >= stiff_; }
  /// No other method suits. The next question comes after `times` as many steps.
  void put_off(int times) noexcept {
    wanted_ = std::min(times * wanted_, thresholds::latest_question);
    watch_anew();
  }

  /// Looks at a step of size h to x1, with f at both ends, and f at (t + h, x), where x is another
  /// approximation of x1.
  void look(double h, VectorView x1, VectorView x, VectorView f, VectorView f0, VectorView f1) {
    if (stiff_step(h, x1, x, f, f0, f1))
      ++stiff_, not_stiff_ = 0;
    else if (++not_stiff_ == thresholds::other_steps)
      stiff_ = smooth_steps_ = 0;
    count_long(h, x1, f0, f1);
  }

 private:
  void count_long(double h, VectorView x1, VectorView f0, VectorView f1) {
    ++looks_, span_ += h;
    if (h * rate_ > turning_)
      ++long_, others_ = 0, swing_ += largest(f1 - f0, x1);
    else if (++others_ == thresholds::other_steps)
      watch_anew();
  }
  void watch_anew() noexcept { long_ = others_ = looks_ = 0, span_ = swing_ = 0.0; }

  bool stiff_step(double h, VectorView x1, VectorView x, VectorView f, VectorView f0,
                  VectorView f1) {
    const double distance = (x1 - x).norm();
    if (!(distance > 0.0)) return false;
    rate_ = (f1 - f).norm() / distance;
    const double reach = h * rate_;
    if (!(reach > thresholds::least_reach)) return false;
    const double turned = in_tolerances(f1 - f0, x1) / in_tolerances(f1, x1);
    const bool smooth = turned < std::min(smooth_, thresholds::smooth_turn * reach);
    if (smooth) ++smooth_steps_;
    return smooth || reach > stability_;
  }

  /// |value| in units of the tolerance.
  template <class Value>
  double in_tolerances(const Value& value, VectorView x1) const {
    return measured(value, x1, [](const auto& scaled) { return scaled.matrix().norm(); });
  }
  /// The largest part of it. An oscillation of the solution may be in one state of many.
  template <class Value>
  double largest(const Value& value, VectorView x1) const {
    return measured(value, x1, [](const auto& scaled) { return scaled.abs().maxCoeff(); });
  }
  template <class Value, class Norm>
  double measured(const Value& value, VectorView x1, const Norm& norm) const {
    const auto size = x1.array().abs();
    if (options_.rtols.empty()) return norm(value.array() / (options_.atol + options_.rtol * size));
    const VectorView rtol(options_.each_rtol(), x1.size()), atol(options_.each_atol(), x1.size());
    return norm(value.array() / (atol.array() + rtol.array() * size));
  }

  double stability_, turning_, amplitude_, smooth_;
  SolverOptions options_;
  int stiff_ = 0, not_stiff_ = 0, smooth_steps_ = 0;
  double rate_ = 0.0;
  int long_ = 0, others_ = 0, looks_ = 0;  // steps beyond turning_, others in a row, all of them
  int wanted_ = thresholds::stiff_steps;
  double span_ = 0.0;   // [s] of all of them
  double swing_ = 0.0;  // sum of |f1 - f0| [tolerances / s] of the first
};

}  // namespace saltus
