// A function of one number that is a line or a constant between knots, with one guard for all knots.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// Knots k_0 < k_1 < ...; piece s lies between k_(s-1) and k_s, and the outer pieces go on without
/// an end. A relation holds whether the number of the piece is even. The value is that of the
/// nearest piece of the kind that is held, so it is smooth beyond the next knot too: a step of the
/// solver that goes too far, up to the middle of the next piece, sees no kink.
class Pieces {
 public:
  /// The pieces of a table; interpolation: linear, nearest, flat; extrapolation: clip, linear,
  /// error. ModelError for other words, and for points that do not increase.
  Pieces(const std::string& block, std::vector<double> points, std::string_view interpolation,
         std::string_view extrapolation);

  /// Positive on even pieces, negative on odd ones, 0 at the knots: the distance to the nearest.
  template <class Number, class Choose>
  Number guard(const Number& u, Choose choose) const {
    if (knots_.empty()) return Number(1.0);
    Number distance = knots_[0] - u;
    for (std::size_t j = 1; j < knots_.size(); ++j) {
      const double sign = j % 2 == 0 ? 1.0 : -1.0;
      distance = choose(u >= middle(j), sign * (knots_[j] - u), distance);
    }
    return distance;
  }

  /// The value at u, where `value(i)` is that of point i and `even` is held.
  template <class Number, class Value, class Choose>
  Number value(const Number& u, const Number& even, Value value, Choose choose) const {
    const Number zero = of_kind(0, u, value, choose);
    return knots_.empty() ? zero : choose(even, zero, of_kind(1, u, value, choose));
  }

  bool bounded() const noexcept { return bounded_; }
  double first() const { return points_.front(); }
  double last() const { return points_.back(); }
  std::size_t knots() const noexcept { return knots_.size(); }

 private:
  struct Piece {
    std::size_t point = 0;  ///< the point at its left, or the point whose value it has
    bool line = false;
  };

  void set_lines(bool clipped);
  void set_constants(bool nearest);
  double middle(std::size_t j) const { return 0.5 * (knots_[j - 1] + knots_[j]); }

  template <class Number, class Value, class Choose>
  Number of_kind(std::size_t first, const Number& u, Value value, Choose choose) const {
    Number result = of_piece(first, u, value);
    for (std::size_t s = first + 2; s < pieces_.size(); s += 2)
      result = choose(u >= middle(s - 1), of_piece(s, u, value), result);
    return result;
  }
  template <class Number, class Value>
  Number of_piece(std::size_t s, const Number& u, Value value) const {
    const auto [i, line] = pieces_[s];
    if (!line) return Number(value(i));
    const double start = points_[i], length = points_[i + 1] - start;
    return value(i) + (value(i + 1) - value(i)) * ((u - start) / length);
  }

  std::vector<double> points_, knots_;
  std::vector<Piece> pieces_;  // one more than knots
  bool bounded_ = false;
};

}  // namespace saltus::detail
