// Guard polynomials: all guards between two looks as polynomials in time, and the roots of these.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/solver/detail/dip.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// The values of all guards at the Chebyshev points of an interval. They determine a polynomial for
/// each guard, which the barycentric formula reads (J.-P. Berrut, L. N. Trefethen, SIAM Review 46
/// (2004), p. 504). Where the last Chebyshev coefficients of a guard are as small as rounding, the
/// polynomial is the guard (L. N. Trefethen, "Approximation Theory and Approximation Practice",
/// 2013, ch. 8), and its root costs no further look.
class GuardPolynomials {
 public:
  /// The interpolant of every method has degree 12 or less.
  static constexpr int degree = 12;

  /// An interval begins; the guards at its ends are known.
  void begin(double from, double to, const std::vector<double>& at_from,
             const std::vector<double>& at_to) {
    from_ = from, to_ = to;
    for (int j = 1; j < degree; ++j) values(j).resize(at_to.size());
    values(0) = at_from, values(degree) = at_to;
  }
  /// The offset of point j; 0 is the beginning, `degree` the end.
  double point(int j) const {
    return j == degree ? to_ : from_ + (to_ - from_) * nth(table().node, j);
  }
  /// The guards at point j.
  std::vector<double>& values(int j) { return values_[j]; }
  const std::vector<double>& values(int j) const { return values_[j]; }
  double value(int j, std::size_t k) const { return values(j)[k]; }

  /// Whether guard k, which is on `side` before point `first` and on the other side from there on,
  /// seems to touch zero between two of the points that have one side.
  bool may_dip(std::size_t k, double side, int first) const {
    for (int j = 2; j <= degree; ++j) {
      if (j >= first && j - 2 < first) continue;
      const double s = j < first ? side : -side;
      const Dip dip{{point(j - 2), point(j - 1), point(j)},
                    {s * value(j - 2, k), s * value(j - 1, k), s * value(j, k)}};
      const double size = std::max({dip.g[0], dip.g[1], dip.g[2]}),
                   u = dip.vertex(thresholds::shallow_dip * size);
      if (u > dip.u[0] && u < dip.u[2]) return true;
    }
    return false;
  }

  /// Bounds of the difference between guard k and its polynomial: the terms that it leaves out, and
  /// the rounding of the formula.
  struct Error {
    double truncation = 0.0, rounding = 0.0;
    double sum() const { return truncation + rounding; }
    /// Whether more looks in a shorter interval would help.
    bool is_truncated() const { return truncation > thresholds::truncated_roundings * rounding; }
  };
  Error error(std::size_t k) const {
    Error found;
    for (int j = 0; j <= degree; ++j)
      found.rounding = std::max(found.rounding, std::abs(value(j, k)));
    found.rounding *= thresholds::formula_roundings * thresholds::eps;
    for (const auto& cosines : table().last_terms) {
      double term = 0.0;
      for (int j = 0; j <= degree; ++j) term += nth(cosines, j) * value(j, k);
      found.truncation = std::max(found.truncation, thresholds::omitted_terms * std::abs(term));
    }
    return found;
  }

  /// An offset at which guard k has surely crossed zero between the points first - 1 and first, at
  /// most `room` after its crossing; empty if the error allows none.
  std::optional<double> crossing(std::size_t k, int first, double error, double room) const {
    const double root = root_of(k, first), small = thresholds::slope_share * (to_ - from_);
    const double a = std::max(from_, root - small), b = std::min(to_, root + small);
    const double slope = std::abs(at(k, b) - at(k, a)) / (b - a);
    const double shift = error / slope;
    if (!(shift <= room)) return {};
    return std::min(root + shift, point(first));
  }

 private:
  struct Table {
    std::array<double, degree + 1> node{}, weight{};
    std::array<std::array<double, degree + 1>, 3> last_terms{};  // of the last three coefficients
  };
  static const Table& table() {
    static const Table made = [] {
      Table t;
      for (int j = 0; j <= degree; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const double angle = std::numbers::pi * j / degree, s = std::sin(0.5 * angle),
                     end = j == 0 || j == degree ? 0.5 : 1.0;
        t.node[i] = j == degree ? 1.0 : s * s;
        t.weight[i] = j % 2 == 0 ? end : -end;
        for (int m = 0; m < 3; ++m)
          nth(t.last_terms, m)[i] =
              (m == 0 ? 1.0 : 2.0) / degree * end * std::cos((degree - m) * angle);
      }
      return t;
    }();
    return made;
  }

  /// The polynomial of guard k at offset u.
  double at(std::size_t k, double u) const {
    const double s = (u - from_) / (to_ - from_);
    double above = 0.0, below = 0.0;
    for (int j = 0; j <= degree; ++j) {
      const double apart = s - nth(table().node, j);
      if (apart == 0.0) return value(j, k);
      const double weight = nth(table().weight, j) / apart;
      above += weight * value(j, k), below += weight;
    }
    return above / below;
  }

  /// A bracket of a root with the values at its ends, and how often in a row the upper end (> 0) or
  /// the lower end (< 0) was moved. As in Narrower::narrow.
  struct Bracket {
    double low, high, a, b;
    int moved = 0;

    /// The part of the bracket at which to look next: by Illinois, and by bisection in the end.
    double part(int looks) const {
      const double wa = std::abs(a) * (moved > 1 ? 0.5 : 1.0),
                   wb = std::abs(b) * (moved < -1 ? 0.5 : 1.0);
      return looks > thresholds::bisects_after || !(wa + wb > 0.0) ? 0.5 : wa / (wa + wb);
    }
    void take(double u, double g, bool crossed) {
      if (crossed)
        high = u, b = g, moved = std::max(moved, 0) + 1;
      else
        low = u, a = g, moved = std::min(moved, 0) - 1;
    }
  };

  /// The root of the polynomial of guard k between the points first - 1 and first.
  double root_of(std::size_t k, int first) const {
    Bracket bracket{point(first - 1), point(first), value(first - 1, k), value(first, k)};
    const auto& [low, high, a, b, moved] = bracket;
    const bool rises = (b == 0.0 ? -a : b) > 0.0;
    for (int looks = 0; looks < thresholds::most_looks && b != 0.0; ++looks) {
      const double resolution = thresholds::eps * high;
      if (high - low <= thresholds::bracket_roundings * resolution) break;
      const double u =
          std::clamp(low + bracket.part(looks) * (high - low), low + resolution, high - resolution);
      const double g = at(k, u);
      bracket.take(u, g, g == 0.0 || (g > 0.0) == rises);
    }
    return high;
  }

  double from_ = 0.0, to_ = 1.0;
  std::array<std::vector<double>, degree + 1> values_;
};

}  // namespace saltus
