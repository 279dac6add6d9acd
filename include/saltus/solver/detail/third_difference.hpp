// ThirdDifference: how far a guard may be from the parabola through three looks at it.
#pragma once

#include <cmath>

namespace saltus {

/// The offsets of four looks. The parabola through the last three of them differs from the guard
/// between the last two by at most
///
///     max |g'''| / 6 |u - u1| |u - u2| |u - u3| <= |g[u0, u1, u2, u3]| (u3 - u1) (u3 - u2)^2 / 4,
///
/// if the third derivative does not vary (the error of interpolation; G. Dahlquist, A. Bjorck,
/// "Numerical Methods", 1974, section 4.3.1). The divided difference g[...] is the guard's own.
class ThirdDifference {
 public:
  constexpr ThirdDifference(double u0, double u1, double u2, double u3) {
    // Ratios of lengths, because products of three lengths may be out of range.
    const double h = u3 - u2, first = h / (u1 - u0), second = h / (u2 - u1), all = h / (u3 - u0);
    const double overlap = -0.25 * ((u3 - u1) / (u2 - u0));
    w0_ = overlap * (first * all), w1_ = 0.25 * (first * second);
    w2_ = overlap * second, w3_ = 0.25 * all;
  }
  /// The bound is 0, where fewer than four looks are known.
  constexpr ThirdDifference() = default;

  /// The bound with its sign, for the values at the four looks.
  constexpr double of(double g0, double g1, double g2, double g3) const {
    return w0_ * g0 + w1_ * g1 + w2_ * g2 + w3_ * g3;
  }
  /// How much of the bound may be rounding, where each value is off by at most `each`.
  double rounding(double each) const {
    return (std::abs(w0_) + std::abs(w1_) + std::abs(w2_) + std::abs(w3_)) * each;
  }

 private:
  double w0_ = 0.0, w1_ = 0.0, w2_ = 0.0, w3_ = 0.0;
};

}  // namespace saltus
