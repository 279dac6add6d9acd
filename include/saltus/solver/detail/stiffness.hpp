// Stiffness for an explicit method: whether stability, not the solution, bounds the step.
#pragma once

#include <cmath>

#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Tests for two signs of stiffness, from values that a step computes anyway.
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
class StiffnessTest {
 public:
  /// `calls`: calls of the right-hand side in a step.
  StiffnessTest(double stability, double calls, const SolverOptions& options)
      : stability_(stability),
        smooth_(thresholds::saved_calls * calls / thresholds::bdf_calls * thresholds::bdf_step *
                std::pow(options.rtol, 1.0 / 6.0)),
        options_(options) {}

  bool detected() const noexcept { return stiff_ >= thresholds::stiff_steps; }
  void forget() noexcept { stiff_ = calm_ = 0; }

  /// Looks at a step of size h to x1, with f at both ends, and f at (t + h, x), where x is another
  /// approximation of x1.
  void look(double h, VectorView x1, VectorView x, VectorView f, VectorView f0, VectorView f1) {
    if (stiff_step(h, x1, x, f, f0, f1))
      ++stiff_, calm_ = 0;
    else if (++calm_ == thresholds::other_steps)
      stiff_ = 0;
  }

 private:
  bool stiff_step(double h, VectorView x1, VectorView x, VectorView f, VectorView f0,
                  VectorView f1) const {
    const double distance = (x1 - x).norm();
    if (!(distance > 0.0)) return false;
    const double reach = h * (f1 - f).norm() / distance;  // h |lambda|
    if (reach > stability_) return true;
    return reach > thresholds::least_reach &&
           turned(x1, f0, f1) < std::min(smooth_, thresholds::smooth_turn * reach);
  }

  /// |f1 - f0| / |f1|, in units of the tolerance.
  double turned(VectorView x1, VectorView f0, VectorView f1) const {
    const auto ratio = [&](const auto& weight) {
      return ((f1 - f0).array() * weight).matrix().norm() / (f1.array() * weight).matrix().norm();
    };
    const auto size = x1.array().abs();
    if (options_.rtols.empty()) return ratio((options_.atol + options_.rtol * size).inverse());
    const auto each = [&](const double* tolerances) { return VectorView(tolerances, x1.size()); };
    const VectorView rtol = each(options_.each_rtol()), atol = each(options_.each_atol());
    return ratio((atol.array() + rtol.array() * size).inverse());
  }

  double stability_, smooth_;
  SolverOptions options_;
  int stiff_ = 0, calm_ = 0;
};

}  // namespace saltus
