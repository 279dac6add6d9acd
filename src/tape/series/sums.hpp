// The sums of a recurrence: u_1 v_{k-1} + u_2 v_{k-2} + ... + u_{k-1} v_1.
//
// Orders are computed in blocks of four. At the start of a block, `earlier_product` adds up the
// products of coefficients that are known from earlier blocks, for all four orders: no sum across a
// register, no load of what has just been stored, and loops only once in four orders. Then `inner`
// adds the few others.
#pragma once

#include "number.hpp"

namespace saltus::tape::series {

/// The sum of u_j v_{l + 4 - j} for j = l + 1 ... 3, where v begins 4 places earlier.
template <int l, class N>
[[gnu::always_inline]] inline N first_products(Row<N> u, Row<N> v) {
  N sum = u[3] * v[l + 1];
  if constexpr (l < 2) sum += u[2] * v[l + 2];
  if constexpr (l < 1) sum += u[1] * v[l + 3];
  return sum;
}

/// For orders k ... k + 3 the sum of u_j v_{order - j} with both places from 1 to k - 1; k is a
/// multiple of 4.
[[gnu::always_inline]] inline void earlier_product(Row<double> u, Row<double> v, Index k,
                                                   double* sums) {
  const Row<double> last = v.from(k - 4);
  Four even{Two{first_products<0>(u, last), first_products<1>(u, last)},
            Two{first_products<2>(u, last), 0.0}};
  Four odd;
  for (Index j = 4; j < k; j += 2) {
    even += u[j] * Four::load(v.p + k - j);
    odd += u[j + 1] * Four::load(v.p + k - j - 1);
  }
  (even + odd).store(sums);
}
[[gnu::always_inline]] inline void earlier_product(Row<Four> u, Row<Four> v, Index k,
                                                   double* sums) {
  const Row<Four> last = v.from(k - 4);
  Four s0 = first_products<0>(u, last), s1 = first_products<1>(u, last),
       s2 = first_products<2>(u, last), s3;
  for (Index j = 4; j < k; ++j) {
    const Four a = u[j];
    s0 += a * v[k - j], s1 += a * v[k - j + 1], s2 += a * v[k - j + 2], s3 += a * v[k - j + 3];
  }
  s0.store(sums), s1.store(sums + 4), s2.store(sums + 8), s3.store(sums + 12);
}

/// The same for u = v, with half of the products.
[[gnu::always_inline]] inline void earlier_square(Row<double> u, Index k, double* sums) {
  if (k == 4) {
    Four{Two{2.0 * (u[1] * u[3]) + u[2] * u[2], 2.0 * (u[2] * u[3])}, Two{u[3] * u[3], 0.0}}.store(
        sums);
    return;
  }
  const Row<double> last = u.from(k - 4);
  Four even{Two{first_products<0>(u, last), first_products<1>(u, last)},
            Two{first_products<2>(u, last), 0.0}};
  Four odd;
  const Index half = k / 2;
  for (Index j = 4; j < half; j += 2) {
    even += u[j] * Four::load(u.p + k - j);
    odd += u[j + 1] * Four::load(u.p + k - j - 1);
  }
  const double a = u[half], b = u[half + 1], c = u[half + 2], d = u[half + 3];
  even.low += Two{0.5 * a * a, a * b};
  even.high += Two{a * c + 0.5 * b * b, a * d + b * c};
  (2.0 * (even + odd)).store(sums);
}
[[gnu::always_inline]] inline void earlier_square(Row<Four> u, Index k, double* sums) {
  if (k == 4) {
    (2.0 * (u[1] * u[3]) + u[2] * u[2]).store(sums);
    (2.0 * (u[2] * u[3])).store(sums + 4);
    (u[3] * u[3]).store(sums + 8);
    Four().store(sums + 12);
    return;
  }
  const Row<Four> last = u.from(k - 4);
  Four s0 = first_products<0>(u, last), s1 = first_products<1>(u, last),
       s2 = first_products<2>(u, last), s3;
  const Index half = k / 2;
  for (Index j = 4; j < half; ++j) {
    const Four a = u[j];
    s0 += a * u[k - j], s1 += a * u[k - j + 1], s2 += a * u[k - j + 2], s3 += a * u[k - j + 3];
  }
  const Four a = u[half], b = u[half + 1], c = u[half + 2], d = u[half + 3];
  (2.0 * s0 + a * a).store(sums);
  (2.0 * (s1 + a * b)).store(sums + 4);
  (2.0 * (s2 + a * c) + b * b).store(sums + 8);
  (2.0 * (s3 + a * d + b * c)).store(sums + 12);
}

/// The order of slot 1, 2 or 3 is the slot; slot 4 + p is order p of a later block.
template <int slot>
inline constexpr int phase = slot < 4 ? slot : slot - 4;

/// The sum of u_j v_{k-j} for j = 1 ... k - 1. `sums` is what `earlier_product` has stored.
template <int slot, class N>
[[gnu::always_inline]] inline N inner(Row<N> u, Row<N> v, Row<N> sums, Index k) {
  constexpr int p = phase<slot>;
  N sum{};
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
template <int slot, class N>
[[gnu::always_inline]] inline N inner_square(Row<N> u, Row<N> sums, Index k) {
  constexpr int p = phase<slot>;
  N sum{};
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
