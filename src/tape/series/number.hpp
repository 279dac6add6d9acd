// The numbers of a recurrence: a single number, or four at once for four alike expressions.
#pragma once

#include <cstring>
#include <type_traits>

#include "saltus/base/ids.hpp"

namespace saltus::tape::series {

using Two = double __attribute__((vector_size(16)));

/// Four numbers.
struct Four {
  Two low = {}, high = {};

  static Four load(const double* p) {
    Four four;
    std::memcpy(&four.low, p, sizeof four.low);
    std::memcpy(&four.high, p + 2, sizeof four.high);
    return four;
  }
  void store(double* p) const {
    std::memcpy(p, &low, sizeof low);
    std::memcpy(p + 2, &high, sizeof high);
  }
  friend Four operator+(const Four& a, const Four& b) { return {a.low + b.low, a.high + b.high}; }
  friend Four operator-(const Four& a, const Four& b) { return {a.low - b.low, a.high - b.high}; }
  friend Four operator*(const Four& a, const Four& b) { return {a.low * b.low, a.high * b.high}; }
  friend Four operator*(double a, const Four& b) { return {a * b.low, a * b.high}; }
  friend Four operator/(double a, const Four& b) { return {a / b.low, a / b.high}; }
  Four& operator+=(const Four& b) { return *this = *this + b; }
};

/// How many numbers of memory a number of a row takes.
template <class N>
inline constexpr Index width = std::is_same_v<N, Four> ? 4 : 1;
inline constexpr Index lanes = width<Four>;

[[gnu::always_inline]] inline Four side_by_side(double a, double b, double c, double d) {
  return {Two{a, b}, Two{c, d}};
}

inline void put(double* p, double a) { *p = a; }
inline void put(double* p, const Four& a) { a.store(p); }

/// The numbers of a row.
template <class N>
struct Row {
  const double* p = nullptr;

  [[gnu::always_inline]] N operator[](Index k) const {
    if constexpr (width<N> == 1) {
      return p[k];
    } else {
      return Four::load(static_cast<const double*>(__builtin_assume_aligned(p + lanes * k, 16)));
    }
  }
  /// The coefficients of order k ... k + 3 of a single expression.
  [[gnu::always_inline]] Four four(Index k) const { return Four::load(p + k); }
  static N zero() { return N{}; }
  Row from(Index k) const { return {p + width<N> * k}; }
};

}  // namespace saltus::tape::series
