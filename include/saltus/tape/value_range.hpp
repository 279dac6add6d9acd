// ValueRange: bounds of the values of an expression.
#pragma once

#include <algorithm>
#include <limits>

namespace saltus::tape {

/// The values from `low` to `high`; each side is infinite if nothing is known.
struct ValueRange {
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double low = -infinite, high = infinite;

  bool changes_sign() const { return low < 0.0 && high > 0.0; }
  bool has_zero() const { return !(low > 0.0 || high < 0.0); }
  double width() const { return high - low; }
};

inline ValueRange operator+(const ValueRange& a, const ValueRange& b) {
  return {a.low + b.low, a.high + b.high};
}
inline ValueRange operator-(const ValueRange& a) { return {-a.high, -a.low}; }
/// A product of unbounded factors that keep their signs keeps its sign too.
inline ValueRange operator*(const ValueRange& a, const ValueRange& b) {
  const auto product = [](double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; };
  const auto [low, high] = std::minmax({product(a.low, b.low), product(a.low, b.high),
                                        product(a.high, b.low), product(a.high, b.high)});
  return {low, high};
}

}  // namespace saltus::tape
