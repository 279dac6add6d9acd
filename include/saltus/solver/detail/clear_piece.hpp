// ClearPiece: whether four looks at a guard show that nothing happens between the last two.
#pragma once

#include <algorithm>
#include <cmath>

#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/third_difference.hpp"
#include "saltus/solver/detail/turn_range.hpp"

namespace saltus {

/// A sufficient test that most pieces pass: the guard stays on its side, the parabola through the
/// last three looks has no vertex in the piece, and this parabola is so near to the guard that the
/// guard cannot have come to zero. A piece that does not pass is judged by the exact tests.
class ClearPiece {
 public:
  constexpr ClearPiece(const TurnRange& turn, const ThirdDifference& third)
      : turn_(turn), third_(third) {}
  /// Only the side counts, where nothing is known but the last two looks.
  constexpr ClearPiece() = default;

  /// Whether a guard with these values at the four looks passes. A value that is not finite does
  /// not, because it makes the error infinite or NaN.
  [[gnu::always_inline]] bool passes(double side, double g0, double g1, double g2,
                                     double g3) const {
    const double before = side * g2, now = side * g3;
    return now > 0.0 && !turn_.contains(before - side * g1, now - before) &&
           thresholds::hidden_room * std::abs(third_.of(g0, g1, g2, g3)) <= std::min(before, now);
  }

 private:
  TurnRange turn_;
  ThirdDifference third_;
};

}  // namespace saltus
