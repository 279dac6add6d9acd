// The fastest part of a scene, without a Jacobian: its rate, and whether it oscillates.
#pragma once

#include <cmath>
#include <limits>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/solver/detail/solver.hpp"
#include "saltus/solver/detail/stiff_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// Nonlinear power iteration (B. P. Sommeijer, L. F. Shampine, J. G. Verwer, "RKC: an explicit
/// solver for parabolic PDEs", J. Comput. Appl. Math. 88 (1997) 315, section 2.2): v <- f(x + v) -
/// f(x), kept small; its growth estimates |lambda|. Lengths are measured in |x| + atol / rtol of
/// each state, which changes no eigenvalue. It takes three iterations from the direction found
/// last, with a small part of every other direction. They give the order of magnitude, which is
/// enough to choose a method. They cost four calls of the right-hand side.
///
/// A pair of complex eigenvalues turns v for ever, and one growth depends on where v is. So the
/// last three vectors are fitted by J^2 v = a J v + b v, whose roots are the pair (Y. Saad,
/// "Numerical Methods for Large Eigenvalue Problems", 1992, IV.1). Many pairs on the imaginary
/// axis, those of an elastic structure, leave the span of two vectors; but J^2 has real eigenvalues
/// -w^2 then, and turns v back, while one J may lengthen it by 10 and the next by 10^6 where the
/// states are angles and their rates. If v is turned back by most, but not by all, the iteration
/// goes on.
class SpectralRadius {
 public:
  SpectralRadius(Machine& machine, const SolverOptions& options)
      : machine_(&machine),
        floor_(floor_of(options, machine.plan().nx)),
        direction_(Eigen::VectorXd::Zero(machine.plan().nx)),
        f_(direction_),
        moved_(direction_),
        scale_(direction_),
        point_(direction_),
        last_(direction_),
        before_last_(direction_) {}

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
    damping_ = 1.0;
    for (int k = 0;
         k < thresholds::power_iterations || (undecided() && k < thresholds::most_power_iterations);
         ++k) {
      before_last_.swap(last_), last_ = direction_, growth_before_ = growth;
      growth = iterate(t, x, small);
      if (growth == 0.0) return 0.0;
      if (!std::isfinite(growth)) {
        forget();
        return std::numeric_limits<double>::infinity();
      }
      if (k > 0) fit(growth);
    }
    return rate(growth);
  }

  /// The damping ratio of the part found last, -Re lambda / |lambda|; 1 if lambda is real.
  double damping() const noexcept { return damping_; }

  /// Forgets the direction, so that later results do not depend on earlier calls.
  void forget() { direction_.setZero(); }

 private:
  /// atol / rtol of each state.
  static Eigen::VectorXd floor_of(const SolverOptions& options, Index n) {
    if (options.rtols.empty()) return Eigen::VectorXd::Constant(n, options.atol / options.rtol);
    return VectorView(options.each_atol(), n).cwiseQuotient(VectorView(options.each_rtol(), n));
  }

  /// v <- J v / |J v|. Returns |J v|.
  double iterate(double t, const Eigen::VectorXd& x, double small) {
    point_ = x + small * scale_.cwiseProduct(direction_);
    machine_->derivative(t, point_.data(), moved_.data());
    direction_ = (moved_ - f_).cwiseQuotient(scale_) / small;
    const double growth = direction_.norm();
    if (growth > 0.0 && std::isfinite(growth)) direction_ /= growth;
    return growth;
  }

  /// Fits the last three vectors: direction_ = a last_ + b growth_before / growth before_last_,
  /// with a and b in units of the growth.
  void fit(double growth) {
    const double overlap = before_last_.dot(last_);
    const double p = direction_.dot(last_);
    turned_ = 1.0 - overlap * overlap, twice_ = direction_.dot(before_last_);
    if (!is_turned()) return;
    const double c = (twice_ - overlap * p) / turned_;
    a_ = (p - overlap * twice_) / turned_, b_ = growth_before_ / growth * c;
    unexplained_ = (direction_ - a_ * last_ - c * before_last_).norm() / std::sqrt(turned_);
  }
  bool is_turned() const { return !(turned_ < thresholds::no_turn); }

  /// Whether J^2 turns the vector back, but more than one pair takes part in it.
  bool undecided() const {
    return is_turned() && unexplained_ > thresholds::unexplained_turn && twice_ < -0.5 &&
           twice_ > -thresholds::turned_back;
  }

  /// |lambda| of the pair that turned the last vectors, or the growth if they turned by a rounding
  /// only, or by two real eigenvalues.
  double rate(double growth) {
    if (!is_turned()) return growth;
    if (unexplained_ > thresholds::unexplained_turn && twice_ < -thresholds::turned_back) {
      damping_ = std::sqrt(std::max(0.5 * (1.0 + twice_), 0.0));
      return std::sqrt(growth * growth_before_);
    }
    if (!(0.25 * a_ * a_ + b_ < 0.0)) return growth;
    damping_ = -0.5 * a_ / std::sqrt(-b_);
    return growth * std::sqrt(-b_);
  }

  Machine* machine_;
  double damping_ = 1.0, growth_before_ = 0.0;
  // What `fit` has found.
  double a_ = 0.0, b_ = 0.0, turned_ = 0.0, twice_ = 0.0, unexplained_ = 0.0;
  Eigen::VectorXd floor_, direction_, f_, moved_, scale_, point_;
  Eigen::VectorXd last_, before_last_;  // directions
};

}  // namespace saltus
