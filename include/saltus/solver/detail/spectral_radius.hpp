// The spectral radius of the Jacobian of a scene, without a Jacobian: the rate of its fastest part.
#pragma once

#include <cmath>
#include <limits>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Nonlinear power iteration (B. P. Sommeijer, L. F. Shampine, J. G. Verwer, "RKC: an explicit
/// solver for parabolic PDEs", J. Comput. Appl. Math. 88 (1997) 315, section 2.2): v <- f(x + v) -
/// f(x), kept small; its growth estimates |lambda|. Lengths are measured in |x| + atol / rtol of
/// each state, which changes no eigenvalue. It takes three iterations from the direction found
/// last, with a small part of every other direction. They give the order of magnitude, which is
/// enough to choose a method. They cost four calls of the right-hand side.
class SpectralRadius {
 public:
  SpectralRadius(Machine& machine, const SolverOptions& options)
      : machine_(&machine),
        floor_(floor_of(options, machine.plan().nx)),
        direction_(Eigen::VectorXd::Zero(machine.plan().nx)),
        f_(direction_),
        moved_(direction_),
        scale_(direction_),
        point_(direction_) {}

  /// |lambda| [1/s] at (t, x); infinite where f is not finite nearby.
  double operator()(double t, const Eigen::VectorXd& x) {
    if (x.size() == 0) return 0.0;
    const double small = std::sqrt(thresholds::eps);
    scale_ = x.cwiseAbs() + floor_;
    for (Index i = 0; i < x.size(); ++i)
      direction_[i] += thresholds::other_directions * std::cos(static_cast<double>(i + 1));
    direction_.normalize();
    machine_->derivative(t, x.data(), f_.data());
    double growth = 0.0;
    for (int k = 0; k < thresholds::power_iterations; ++k) {
      point_ = x + small * scale_.cwiseProduct(direction_);
      machine_->derivative(t, point_.data(), moved_.data());
      direction_ = (moved_ - f_).cwiseQuotient(scale_) / small;
      growth = direction_.norm();
      if (growth == 0.0) return 0.0;
      if (!std::isfinite(growth)) {
        forget();
        return std::numeric_limits<double>::infinity();
      }
      direction_ /= growth;
    }
    return growth;
  }

  /// Forgets the direction, so that later results do not depend on earlier calls.
  void forget() { direction_.setZero(); }

 private:
  /// atol / rtol of each state.
  static Eigen::VectorXd floor_of(const SolverOptions& options, Index n) {
    if (options.rtols.empty()) return Eigen::VectorXd::Constant(n, options.atol / options.rtol);
    return VectorView(options.each_atol(), n).cwiseQuotient(VectorView(options.each_rtol(), n));
  }

  Machine* machine_;
  Eigen::VectorXd floor_, direction_, f_, moved_, scale_, point_;
};

}  // namespace saltus
