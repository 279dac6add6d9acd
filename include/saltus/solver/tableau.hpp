// What a tableau of an explicit Runge-Kutta method with dense output offers to the stepper.
#pragma once

#include <array>
#include <cstddef>

namespace saltus {

/// Coefficients of one method, all constexpr:
///   stages            number of stages; the last is f(t + h, x1), the first of the next step
///   a[i][j], c[i]     stage i reads x0 + h sum_j a[i][j] k_j at t + c[i] h; row stages-1 gives x1
///   e[j]              error estimate h sum_j e[j] k_j
///   d[j]              last term of the dense output
///   error_order       the estimate shrinks as h^error_order
///   stability         length of the stability interval on the negative real axis
template <class T>
concept Tableau = requires {
  { T::stages } -> std::convertible_to<std::size_t>;
  T::a;
  T::c;
  T::e;
  T::d;
  T::error_order;
  T::stability;
  T::name;
};

}  // namespace saltus
