// The sums of a recurrence: u_1 v_{k-1} + u_2 v_{k-2} + ... + u_{k-1} v_1.
//
// Orders are computed in blocks of four. At the start of a block, `earlier` adds up the products of
// coefficients that are known from earlier blocks, for all four orders at once: no sum across a
// register, and no load of what has just been stored. Then `inner` adds the few others.
#pragma once

#include <cstring>
#include <utility>

#include "saltus/base/ids.hpp"

namespace saltus::tape::series {

using Two [[gnu::vector_size(16)]] = double;

/// Four numbers, for four orders.
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
  void add(double factor, const Four& b) {
    low += factor * b.low;
    high += factor * b.high;
  }
  friend Four operator+(const Four& a, const Four& b) { return {a.low + b.low, a.high + b.high}; }
  friend Four operator-(const Four& a, const Four& b) { return {a.low - b.low, a.high - b.high}; }
  friend Four operator*(const Four& a, const Four& b) { return {a.low * b.low, a.high * b.high}; }
  friend Four operator/(const Four& a, const Four& b) { return {a.low / b.low, a.high / b.high}; }
  friend Four operator*(double a, const Four& b) { return {a * b.low, a * b.high}; }
  Four& operator+=(const Four& b) { return *this = *this + b; }
  static Four all(double a) { return {Two{a, a}, Two{a, a}}; }
};

/// The products of u_1, u_2, u_3 among the sums below; v_k and later ones are not read.
[[gnu::always_inline]] inline Four first_products(const double* u, const double* v, Index k) {
  Four sum{u[3] * (Two{v[k - 3], v[k - 2]}), u[3] * Two{v[k - 1], 0.0}};
  sum.low += u[2] * Two{v[k - 2], v[k - 1]} + u[1] * Two{v[k - 1], 0.0};
  return sum;
}

/// For orders k ... k + 3 the sum of u_j v_{order - j} with both places from 1 to k - 1; k is a
/// multiple of 4.
[[gnu::always_inline]] inline Four earlier_product(const double* u, const double* v, Index k) {
  Four even = first_products(u, v, k), odd;
  for (Index j = 4; j < k; j += 2) {
    even.add(u[j], Four::load(v + k - j));
    odd.add(u[j + 1], Four::load(v + k - j - 1));
  }
  return even + odd;
}

/// The same for u = v, with half of the products.
[[gnu::always_inline]] inline Four earlier_square(const double* u, Index k) {
  if (k == 4)
    return {Two{2.0 * (u[1] * u[3]) + u[2] * u[2], 2.0 * (u[2] * u[3])}, Two{u[3] * u[3], 0.0}};
  Four even = first_products(u, u, k), odd;
  const Index half = k / 2;
  for (Index j = 4; j < half; j += 2) {
    even.add(u[j], Four::load(u + k - j));
    odd.add(u[j + 1], Four::load(u + k - j - 1));
  }
  const double a = u[half], b = u[half + 1], c = u[half + 2], d = u[half + 3];
  even.low += Two{0.5 * a * a, a * b};
  even.high += Two{a * c + 0.5 * b * b, a * d + b * c};
  return 2.0 * (even + odd);
}

/// The order of slot 1, 2 or 3 is the slot; slot 4 + p is order p of a later block.
template <int slot>
inline constexpr int phase = slot < 4 ? slot : slot - 4;

/// The sum of u_j v_{k-j} for j = 1 ... k - 1. `sums` is what `earlier_product` has stored.
template <int slot>
[[gnu::always_inline]] inline double inner(const double* u, const double* v, const double* sums,
                                           Index k) {
  constexpr int p = phase<slot>;
  double sum = 0.0;
  if constexpr (slot < 4) {
    if constexpr (p > 1) sum = u[1] * v[p - 1];
    if constexpr (p > 2) sum += u[2] * v[1];
  } else {
    sum = sums[p];
    if constexpr (p > 2) sum += u[3] * v[k - 3] + v[3] * u[k - 3];
    if constexpr (p > 1) sum += u[2] * v[k - 2] + v[2] * u[k - 2];
    if constexpr (p > 0) sum += u[1] * v[k - 1] + v[1] * u[k - 1];
  }
  return sum;
}

/// The same for u = v.
template <int slot>
[[gnu::always_inline]] inline double inner_square(const double* u, const double* sums, Index k) {
  constexpr int p = phase<slot>;
  double sum = 0.0;
  if constexpr (slot < 4) {
    if constexpr (p == 2) sum = u[1] * u[1];
    if constexpr (p == 3) sum = 2.0 * (u[1] * u[2]);
  } else {
    if constexpr (p > 2) sum += u[3] * u[k - 3];
    if constexpr (p > 1) sum += u[2] * u[k - 2];
    if constexpr (p > 0) sum += u[1] * u[k - 1];
    sum = sums[p] + 2.0 * sum;
  }
  return sum;
}

}  // namespace saltus::tape::series
