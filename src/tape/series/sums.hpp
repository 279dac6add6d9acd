// The sums of a recurrence: u_1 v_{k-1} + u_2 v_{k-2} + ... + u_{k-1} v_1.
//
// Orders are computed in blocks of four. At the start of a block, `earlier_product` adds up the
// products of coefficients that are known from earlier blocks, for all four orders: no sum across a
// register, no load of a number that has just been stored, and loops only once in four orders. Then
// `inner` adds the few others.
#pragma once

#include "number.hpp"

namespace saltus::tape::series {

/// The sum of u_j v_{l + 4 - j} for j = l + 1 ... 3. The pointer v begins 4 places earlier.
template <int l, class N>
[[gnu::always_inline]] inline N first_products(Row<N> u, Row<N> v) {
  N sum = u[3] * v[l + 1];
  if constexpr (l < 2) sum += u[2] * v[l + 2];
  if constexpr (l < 1) sum += u[1] * v[l + 3];
  return sum;
}
/// These sums for the four orders of a block, of single expressions.
template <class N>
[[gnu::always_inline]] inline auto all_first_products(Row<N> u, Row<N> v) {
  return side_by_side(first_products<0>(u, v), first_products<1>(u, v), first_products<2>(u, v),
                      N{});
}

/// For orders k ... k + 3 the sum of u_j v_{order - j} with both places from 1 to k - 1; k is a
/// multiple of 4. Of single expressions, whose orders are computed side by side.
template <class N, class Place>
[[gnu::always_inline]] inline void earlier_narrow(Row<N> u, Row<N> v, Index k, Place sums) {
  auto even = all_first_products(u, v.from(k - 4));
  decltype(even) odd{};
  for (Index j = 4; j < k; j += 2) {
    even += u[j] * v.four(k - j);
    odd += u[j + 1] * v.four(k - j - 1);
  }
  put(sums, even + odd);
}
/// Of four expressions, each in a lane of its own.
template <class N, class Place>
[[gnu::always_inline]] inline void earlier_wide(Row<N> u, Row<N> v, Index k, Place sums) {
  const Row<N> last = v.from(k - 4);
  N s0 = first_products<0>(u, last), s1 = first_products<1>(u, last),
    s2 = first_products<2>(u, last), s3 = u.zero();
  for (Index j = 4; j < k; ++j) {
    const N a = u[j];
    s0 += a * v[k - j], s1 += a * v[k - j + 1], s2 += a * v[k - j + 2], s3 += a * v[k - j + 3];
  }
  put(sums, s0), put(sums + 4, s1), put(sums + 8, s2), put(sums + 12, s3);
}

/// The same for u = v, with half of the products.
template <class N, class Place>
[[gnu::always_inline]] inline void earlier_square_narrow(Row<N> u, Index k, Place sums) {
  if (k == 4) {
    put(sums,
        side_by_side(2.0 * (u[1] * u[3]) + u[2] * u[2], 2.0 * (u[2] * u[3]), u[3] * u[3], N{}));
    return;
  }
  auto even = all_first_products(u, u.from(k - 4));
  decltype(even) odd{};
  const Index half = k / 2;
  for (Index j = 4; j < half; j += 2) {
    even += u[j] * u.four(k - j);
    odd += u[j + 1] * u.four(k - j - 1);
  }
  const N a = u[half], b = u[half + 1], c = u[half + 2], d = u[half + 3];
  even += side_by_side(0.5 * a * a, a * b, a * c + 0.5 * b * b, a * d + b * c);
  put(sums, 2.0 * (even + odd));
}
template <class N, class Place>
[[gnu::always_inline]] inline void earlier_square_wide(Row<N> u, Index k, Place sums) {
  if (k == 4) {
    put(sums, 2.0 * (u[1] * u[3]) + u[2] * u[2]);
    put(sums + 4, 2.0 * (u[2] * u[3]));
    put(sums + 8, u[3] * u[3]);
    put(sums + 12, u.zero());
    return;
  }
  const Row<N> last = u.from(k - 4);
  N s0 = first_products<0>(u, last), s1 = first_products<1>(u, last),
    s2 = first_products<2>(u, last), s3 = u.zero();
  const Index half = k / 2;
  for (Index j = 4; j < half; ++j) {
    const N a = u[j];
    s0 += a * u[k - j], s1 += a * u[k - j + 1], s2 += a * u[k - j + 2], s3 += a * u[k - j + 3];
  }
  const N a = u[half], b = u[half + 1], c = u[half + 2], d = u[half + 3];
  put(sums, 2.0 * s0 + a * a);
  put(sums + 4, 2.0 * (s1 + a * b));
  put(sums + 8, 2.0 * (s2 + a * c) + b * b);
  put(sums + 12, 2.0 * (s3 + a * d + b * c));
}

template <class N, class Place>
[[gnu::always_inline]] inline void earlier_product(Row<N> u, Row<N> v, Index k, Place sums) {
  if constexpr (std::is_same_v<N, double>)
    earlier_narrow(u, v, k, sums);
  else if constexpr (std::is_same_v<N, Four>)
    earlier_wide(u, v, k, sums);
  else
    u.is_wide() ? earlier_wide(u, v, k, sums) : earlier_narrow(u, v, k, sums);
}
template <class N, class Place>
[[gnu::always_inline]] inline void earlier_square(Row<N> u, Index k, Place sums) {
  if constexpr (std::is_same_v<N, double>)
    earlier_square_narrow(u, k, sums);
  else if constexpr (std::is_same_v<N, Four>)
    earlier_square_wide(u, k, sums);
  else
    u.is_wide() ? earlier_square_wide(u, k, sums) : earlier_square_narrow(u, k, sums);
}

/// The order of slot 1, 2 or 3 is the slot; slot 4 + p is order p of a later block.
template <int slot>
inline constexpr int phase = slot < 4 ? slot : slot - 4;

/// The sum of u_j v_{k-j} for j = 1 ... k - 1. `sums` has the results of `earlier_product`.
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
