// Lane: what the arithmetic of a step handles at once. For a small system of known size that is the
// whole state, unrolled and in registers; for any other one entry after the other.
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

/// All N entries of a state, or with N = 0 one of them.
template <int N>
using Lane = std::conditional_t<N == 0, double, Eigen::Array<double, N == 0 ? 1 : N, 1>>;

template <int N>
Lane<N> zero() {
  if constexpr (N == 0)
    return 0.0;
  else
    return Lane<N>::Zero();
}
/// Entry by entry: a user's function has just stored them so, and a wider load would have to wait
/// until they have reached the cache (11 % of a run of the ball).
template <int N>
Lane<N> load(const double* p) {
  if constexpr (N == 0) return *p;
#ifdef __SSE2__
  else if constexpr (N % 2 == 0) {
    Lane<N> lane;
    for (Index i = 0; i < N; i += 2)
      _mm_store_pd(lane.data() + i, _mm_loadh_pd(_mm_load_sd(p + i), p + i + 1));
    return lane;
  }
#endif
  else
    return Eigen::Map<const Lane<N>>(p);
}
template <int N>
void store(double* p, const Lane<N>& value) {
  if constexpr (N == 0)
    *p = value;
  else
    Eigen::Map<Lane<N>>{p} = value;
}

/// body(i) for the first entry of each lane of a state of n entries.
template <int N, class Body>
void for_lanes(Index n, Body body) {
  if constexpr (N == 0)
    for (Index i = 0; i < n; ++i) body(i);
  else
    body(Index{0});
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
    if constexpr (N == 0) values_.assign(static_cast<std::size_t>(n) * Count, 0.0);
  }
  double* data() noexcept { return values_.data(); }
  const double* data() const noexcept { return values_.data(); }

 private:
  std::conditional_t<N == 0, std::vector<double>, std::array<double, N * Count>> values_{};
};

}  // namespace saltus::detail
