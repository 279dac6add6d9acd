// Computes each operation. Constant folding and tapes both call it, so they agree to the last bit.
#pragma once

#include <cmath>

#include "saltus/tape/operation.hpp"

namespace saltus::tape {

namespace detail {

inline double truth(bool value) { return value ? 1.0 : 0.0; }
inline double sign(double a) { return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : a == 0.0 ? 0.0 : a; }
inline double minimum(double a, double b) { return a <= b || std::isnan(a) ? a : b; }
inline double maximum(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

/// Python's float.__mod__; NaN for b = 0, as numpy.remainder gives.
inline double mod(double a, double b) {
  const double rest = std::fmod(a, b);
  if (rest == 0.0) return b == 0.0 ? rest : std::copysign(0.0, b);
  return (b < 0.0) != (rest < 0.0) ? rest + b : rest;
}

/// Python's float.__floordiv__; a/b for b = 0, as numpy.floor_divide gives. The quotient is first
/// rounded to the nearest whole number, because a - mod(a, b) is a multiple of b up to rounding.
inline double floor_divide(double a, double b) {
  if (b == 0.0) return a / b;
  const double rest = std::fmod(a, b);
  double quotient = (a - rest) / b;
  if (rest != 0.0 && (b < 0.0) != (rest < 0.0)) quotient -= 1.0;
  if (quotient == 0.0) return std::copysign(0.0, a / b);
  const double whole = std::floor(quotient);
  return quotient - whole > 0.5 ? whole + 1.0 : whole;
}

/// Some powers by products and square roots, which is several times quicker than std::pow; see
/// Graph. a + 0.0 is 0 for -0.0, whose root would have the wrong sign.
inline double power(double a, double b) {
  if (b == 1.5) return a * std::sqrt(a);
  if (b == 2.5) return a * a * std::sqrt(a + 0.0);
  if (b == -0.5) return 1.0 / std::sqrt(a + 0.0);
  if (b == -1.5) return 1.0 / (a * std::sqrt(a));
  if (b == -2.0) return 1.0 / (a * a);
  if (b == -3.0) return 1.0 / (a * a * a);
  return std::pow(a, b);
}

}  // namespace detail

/// The value of an operation; operands that it does not take are not read. With a constant `op` the
/// compiler keeps one case of this switch.
[[gnu::always_inline]] inline double compute(Op op, double a, double b, double c) {
  using namespace detail;
  switch (op) {
    case Op::neg:
      return -a;
    case Op::abs:
      return std::fabs(a);
    case Op::sqrt:
      return std::sqrt(a);
    case Op::cbrt:
      return std::cbrt(a);
    case Op::exp:
      return std::exp(a);
    case Op::exp2:
      return std::exp2(a);
    case Op::expm1:
      return std::expm1(a);
    case Op::log:
      return std::log(a);
    case Op::log2:
      return std::log2(a);
    case Op::log10:
      return std::log10(a);
    case Op::log1p:
      return std::log1p(a);
    case Op::sin:
      return std::sin(a);
    case Op::cos:
      return std::cos(a);
    case Op::tan:
      return std::tan(a);
    case Op::asin:
      return std::asin(a);
    case Op::acos:
      return std::acos(a);
    case Op::atan:
      return std::atan(a);
    case Op::sinh:
      return std::sinh(a);
    case Op::cosh:
      return std::cosh(a);
    case Op::tanh:
      return std::tanh(a);
    case Op::asinh:
      return std::asinh(a);
    case Op::acosh:
      return std::acosh(a);
    case Op::atanh:
      return std::atanh(a);
    case Op::floor:
      return std::floor(a);
    case Op::ceil:
      return std::ceil(a);
    case Op::trunc:
      return std::trunc(a);
    case Op::rint:
      return std::nearbyint(a);
    case Op::sign:
      return sign(a);
    case Op::logical_not:
      return truth(a == 0.0);
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return power(a, b);
    case Op::atan2:
      return std::atan2(a, b);
    case Op::hypot:
      return std::hypot(a, b);
    case Op::copysign:
      return std::copysign(a, b);
    case Op::mod:
      return mod(a, b);
    case Op::fmod:
      return std::fmod(a, b);
    case Op::floor_divide:
      return floor_divide(a, b);
    case Op::minimum:
      return minimum(a, b);
    case Op::maximum:
      return maximum(a, b);
    case Op::lt:
      return truth(a < b);
    case Op::le:
      return truth(a <= b);
    case Op::gt:
      return truth(a > b);
    case Op::ge:
      return truth(a >= b);
    case Op::eq:
      return truth(a == b);
    case Op::ne:
      return truth(a != b);
    case Op::logical_and:
      return truth(a != 0.0 && b != 0.0);
    case Op::logical_or:
      return truth(a != 0.0 || b != 0.0);
    case Op::select:
      return a != 0.0 ? b : c;
    default:
      return a;  // the value exists already: a copy
  }
}

}  // namespace saltus::tape
