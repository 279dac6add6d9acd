// Lane: the unit of the arithmetic of a step: two entries of a state in one register, or one entry.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "saltus/base/view.hpp"

namespace saltus::detail {

/// W = 2: two entries of a state; W = 0: one.
template <int W>
using Lane = std::conditional_t<W == 0, double, Eigen::Array2d>;

/// The lane width of a stepper that calls the right-hand side of N states. Four states in pairs, or
/// as a whole, take 1.7 times the time: each load would wait for the stores of the user's function.
template <int N>
inline constexpr int called_width = N == 2 ? 2 : 0;

template <int W>
Lane<W> zero() {
  if constexpr (W == 0)
    return 0.0;
  else
    return Lane<W>::Zero();
}
/// Loads entry by entry, as a user's function has just stored them. A wider load would have to wait
/// until the entries have reached the cache (11 % of a run of the ball).
template <int W>
Lane<W> load(const double* p) {
  if constexpr (W == 0) {
    return *p;
  } else {
    Lane<W> lane;
#ifdef __SSE2__
    _mm_store_pd(lane.data(), _mm_loadh_pd(_mm_load_sd(p), p + 1));
#else
    lane << p[0], p[1];
#endif
    return lane;
  }
}
template <int W>
void store(double* p, const Lane<W>& value) {
  if constexpr (W == 0)
    *p = value;
  else
    Eigen::Map<Lane<W>>{p} = value;
}

/// n, as the constant N if N is not 0.
template <int N>
constexpr Index count(Index n) {
  return N > 0 ? N : n;
}

/// Calls body(i) for the first entry of each lane, of width W, of a state of n entries. N is n, or
/// 0 if n is known at run time only.
template <int W, int N, class Body>
void for_lanes(Index n, Body body) {
  if constexpr (W > 0)
    body(Index{0});
  else if constexpr (N > 0)
    [&]<int... I>(std::integer_sequence<int, I...>) {
      (body(Index{I}), ...);
    }(std::make_integer_sequence<int, N>{});
  else
    for (Index i = 0; i < n; ++i) body(i);
}

/// max(|a|, |b|), entry by entry.
inline double larger(double a, double b) { return std::max(std::abs(a), std::abs(b)); }
template <class A>
auto larger(const Eigen::ArrayBase<A>& a, const Eigen::ArrayBase<A>& b) {
  return a.abs().max(b.abs()).eval();
}

inline double sum_of_squares(double a) { return a * a; }
template <class A>
double sum_of_squares(const Eigen::ArrayBase<A>& a) {
  return a.square().sum();
}

/// Count columns of a state each, one after the other.
template <int N, std::size_t Count>
class Columns {
 public:
  explicit Columns(Index n) {
    if constexpr (N == 0) values_.assign(n * Count, 0.0);
  }
  double* data() noexcept { return values_.data(); }
  const double* data() const noexcept { return values_.data(); }

 private:
  std::conditional_t<N == 0, std::vector<double>, std::array<double, N * Count>> values_{};
};

}  // namespace saltus::detail
