// The pieces between increasing knots, which are found by halving. A relation holds the parity of
// the piece.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"

namespace saltus::detail {

/// Knots k_0 < k_1 < ...; piece s lies between k_(s-1) and k_s, and the outer pieces go on without
/// an end. A relation holds whether the number of the piece is even, so a solver step that ends at
/// a knot, or goes too far, sees one piece.
class Knots {
 public:
  explicit Knots(std::vector<double> knots) : knots_(knots.begin(), knots.end()) {}

  Index size() const { return static_cast<Index>(knots_.size()); }
  double operator[](Index k) const { return knots_[k]; }

  /// The number of knots at or before u, which is the number of its piece.
  Index piece(double u) const { return std::ranges::upper_bound(knots_, u) - knots_.begin(); }

  /// The piece of u if it has the held parity, otherwise the neighbour that is nearest to u.
  Index held(double u, bool even) const {
    const Index now = piece(u);
    if ((now % 2 == 0) == even) return now;
    return before(now, u) <= after(now, u) ? now - 1 : now + 1;
  }

  /// Positive on even pieces, negative on odd ones, 0 at the knots: the distance to the nearest.
  double guard(double u) const {
    if (knots_.empty()) return 1.0;
    const Index now = piece(u);
    const double distance = std::min(before(now, u), after(now, u));
    return now % 2 == 0 ? distance : -distance;
  }

 private:
  double before(Index piece, double u) const { return piece > 0 ? u - knots_[piece - 1] : far; }
  double after(Index piece, double u) const { return piece < size() ? knots_[piece] - u : far; }

  static constexpr double far = std::numeric_limits<double>::infinity();
  List<double> knots_;
};

}  // namespace saltus::detail
