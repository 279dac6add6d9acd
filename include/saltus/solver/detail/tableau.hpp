// The tableau of an explicit Runge-Kutta method with dense output.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <utility>

#include "saltus/solver/detail/lane.hpp"

namespace saltus {

/// Coefficients of one method, all constexpr:
/// - stages: how many; the last is f(t + h, x1), the first of the next step
/// - rows: stages, and the stages for the dense output only, computed at its first use
/// - a[i][j], c[i]: stage i reads x0 + h sum_j a[i][j] k_j at t + c[i] h; row stages - 1 gives x1
/// - e[m][j]: error estimate m is h sum_j e[m][j] k_j
/// - error(squares): the error, from the mean squares of the estimates
/// - error_order: the error shrinks as h^error_order
/// - d[m][j]: dense output of degree 3 + m, h sum_j d[m][j] k_j
/// - stability, imaginary, amplitude: see StabilityBounds
/// - defect_at, defect_share, last_term_share: if its dense output is to be checked, see Halves
/// - beta, shortest, longest: of the step size control, see StepController
template <class T>
concept Tableau = requires {
  { T::stages } -> std::convertible_to<std::size_t>;
  { T::rows } -> std::convertible_to<std::size_t>;
  T::a;
  T::c;
  T::e;
  T::d;
  { T::error({}) } -> std::convertible_to<double>;
  T::error_order;
  T::stability;
  T::imaginary;
  T::amplitude;
  T::beta;
  T::shortest;
  T::longest;
  T::name;
};

namespace detail {

template <auto Row, std::size_t J, int N>
void add_term(Lane<N>& sum, const double* k, Index n) {
  constexpr double weight = Row()[J];
  if constexpr (weight != 0.0) sum += weight * load<N>(k + static_cast<Index>(J) * n);
}

/// sum_j Row[j] k[j n], j < Count; zero terms are left out.
template <auto Row, std::size_t Count, int N>
Lane<N> dot(const double* k, Index n) {
  Lane<N> sum = zero<N>();
  [&]<std::size_t... J>(std::index_sequence<J...>) {
    (add_term<Row, J, N>(sum, k, n), ...);
  }(std::make_index_sequence<Count>{});
  return sum;
}

template <auto Row, std::size_t J, int N>
void add_difference(Lane<N>& sum, const double* k, Index n) {
  constexpr double weight = Row()[J];
  if constexpr (weight != 0.0)
    sum += weight * (load<N>(k + static_cast<Index>(J) * n) - load<N>(k));
}

/// Whether the weights are so large that they lose digits when they cancel: DOP853 has weights of
/// 20 to 44.
template <class Row>
constexpr bool cancels(const Row& row) {
  return std::ranges::any_of(row, [](double w) { return w > 4.0 || w < -4.0; });
}

/// sum_j Row[j] (k[j n] - k[0]), which leaves out k[0] times the sum of the row. If k hardly
/// varies, large weights cancel exactly, without a rounding error.
template <auto Row, std::size_t Count, int N>
Lane<N> dot_of_differences(const double* k, Index n) {
  Lane<N> sum = zero<N>();
  [&]<std::size_t... J>(std::index_sequence<0, J...>) {
    (add_difference<Row, J, N>(sum, k, n), ...);
  }(std::make_index_sequence<Count>{});
  return sum;
}

/// c_J + r (c_J+1 + s (c_J+2 + ...)), with r and s in turns, r after an even J. Coefficient c_j
/// begins at c[j n].
template <std::size_t J, std::size_t Count, int N>
Lane<N> nested(const double* c, Index n, double s, double r) {
  const Lane<N> here = load<N>(c + static_cast<Index>(J) * n);
  if constexpr (J + 1 == Count)
    return here;
  else
    return here + (J % 2 == 0 ? r : s) * nested<J + 1, Count, N>(c, n, s, r);
}

}  // namespace detail

}  // namespace saltus
