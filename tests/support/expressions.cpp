#include "support/expressions.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

namespace support {

using saltus::tape::Op;

namespace {

template <class Number>
struct IsComplex : std::false_type {};
template <class Real>
struct IsComplex<std::complex<Real>> : std::true_type {};

template <class Number>
auto real(const Number& a) {
  if constexpr (IsComplex<Number>::value) {
    return a.real();
  } else {
    return a;
  }
}

template <class Real>
Real remainder(Real a, Real b) {           // with the sign of b
  const Real rest = std::remainder(a, b);  // the nearest to 0, of either sign
  if (rest == Real(0)) return std::copysign(Real(0), b);
  return std::signbit(rest) != std::signbit(b) ? rest + b : rest;
}

/// Operations that real numbers only have; `Real` is double or long double.
template <class Real>
Real of_reals(Op op, Real a, Real b) {
  switch (op) {
    case Op::cbrt:
      return std::cbrt(a);
    case Op::exp2:
      return std::exp2(a);
    case Op::expm1:
      return std::expm1(a);
    case Op::log1p:
      return std::log1p(a);
    case Op::log2:
      return std::log2(a);
    case Op::log10:
      return std::log10(a);
    case Op::acosh:
      return std::acosh(a);
    case Op::atan2:
      return std::atan2(a, b);
    case Op::hypot:
      return std::hypot(a, b);
    case Op::copysign:
      return std::copysign(a, b);
    case Op::mod:
      return remainder(a, b);
    case Op::fmod:
      return std::fmod(a, b);
    case Op::ceil:
      return std::ceil(a);
    case Op::trunc:
      return std::trunc(a);
    case Op::rint:
      return std::rint(a);
    case Op::floor_divide: {
      const Real whole = std::floor(a / b);  // too large by one where a / b was rounded up to it
      const bool over = std::fma(whole, b, -a) * b > Real(0);
      return over ? whole - Real(1) : whole;
    }
    default:
      return std::numeric_limits<Real>::quiet_NaN();
  }
}

/// Comparisons and kinks go by the real part (J. Martins, P. Sturdza, J. Alonso, The complex-step
/// derivative approximation, ACM TOMS 29 (2003), section 4.2).
template <class Number>
Number step(const RandomExpression::Step& s, const std::vector<Number>& v) {
  const Number a = v[s.from[0]], b = v[s.from[1]];
  const auto re = real(a);
  const auto other = real(b);
  using Real = std::remove_const_t<decltype(re)>;
  const auto whole = [](Real value) { return Number(value); };
  const auto truth = [](bool value) { return Number(value ? Real(1) : Real(0)); };
  switch (s.op) {
    case Op::neg:
      return -a;
    case Op::abs:
      return std::signbit(re) ? -a : a;
    case Op::sqrt:
      return std::sqrt(a);
    case Op::exp:
      return std::exp(a);
    case Op::log:
      return std::log(a);
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
    case Op::atanh:
      return std::atanh(a);
    case Op::floor:
      return whole(std::floor(re));
    case Op::sign:
      return whole(re > Real(0) ? Real(1) : re < Real(0) ? Real(-1) : re == Real(0) ? Real(0) : re);
    case Op::add:
      return a + b;
    case Op::sub:
      return a - b;
    case Op::mul:
      return a * b;
    case Op::div:
      return a / b;
    case Op::pow:
      return std::pow(a, b);
    case Op::minimum:
      return re <= other || std::isnan(re) ? a : b;
    case Op::maximum:
      return re >= other || std::isnan(re) ? a : b;
    case Op::lt:
      return truth(re < other);
    case Op::le:
      return truth(re <= other);
    case Op::gt:
      return truth(re > other);
    case Op::ge:
      return truth(re >= other);
    case Op::eq:
      return truth(re == other);
    case Op::ne:
      return truth(re != other);
    case Op::logical_and:
      return truth(re != Real(0) && other != Real(0));
    case Op::logical_or:
      return truth(re != Real(0) || other != Real(0));
    case Op::logical_not:
      return truth(re == Real(0));
    case Op::select:
      return re != Real(0) ? b : v[s.from[2]];
    default:
      return Number(of_reals<Real>(s.op, re, other));
  }
}

}  // namespace

std::vector<saltus::tape::Node> write(const RandomExpression& e, saltus::tape::Graph& graph) {
  std::vector<saltus::tape::Node> states;
  for (std::size_t i = 0; i < e.variables; ++i) {
    states.push_back(graph.continuous_state(static_cast<saltus::Index>(i)));
  }
  return write(e, graph, states);
}

std::vector<saltus::tape::Node> write(const RandomExpression& e, saltus::tape::Graph& graph,
                                      const std::vector<saltus::tape::Node>& variables) {
  std::vector<saltus::tape::Node> nodes = variables;
  for (std::size_t i = e.variables; i < e.steps.size(); ++i) {
    const auto& s = e.steps[i];
    std::vector<saltus::tape::Node> operands;
    for (int k = 0; k < saltus::tape::operand_count(s.op); ++k) {
      operands.push_back(nodes[s.from[static_cast<std::size_t>(k)]]);
    }
    nodes.push_back(operands.empty() ? graph.constant(s.value) : graph.apply(s.op, operands));
  }
  std::vector<saltus::tape::Node> outputs;
  for (const std::size_t output : e.outputs) outputs.push_back(nodes[output]);
  return outputs;
}

template <class Number>
std::vector<Number> evaluate(const RandomExpression& e, const std::vector<Number>& x) {
  std::vector<Number> values(x);
  for (std::size_t i = e.variables; i < e.steps.size(); ++i) {
    const auto& s = e.steps[i];
    using Real = decltype(real(x[0]));
    values.push_back(s.op == Op::constant ? Number(static_cast<Real>(s.value)) : step(s, values));
  }
  std::vector<Number> outputs;
  for (const std::size_t output : e.outputs) outputs.push_back(values[output]);
  return outputs;
}

template std::vector<double> evaluate(const RandomExpression&, const std::vector<double>&);
template std::vector<long double> evaluate(const RandomExpression&,
                                           const std::vector<long double>&);
template std::vector<std::complex<double>> evaluate(const RandomExpression&,
                                                    const std::vector<std::complex<double>>&);

}  // namespace support
