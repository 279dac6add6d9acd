#include "support/expressions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace support {

using saltus::tape::Op;

namespace {

// Complex numbers go through the analytic ones; of the steps the derivative is 0.
constexpr std::array plain = {Op::add, Op::sub, Op::mul, Op::div};
constexpr std::array analytic = {Op::neg,  Op::exp,  Op::log,     Op::sqrt,    Op::sin,
                                 Op::cos,  Op::tan,  Op::sinh,    Op::cosh,    Op::tanh,
                                 Op::asin, Op::acos, Op::atan,    Op::asinh,   Op::atanh,
                                 Op::pow,  Op::abs,  Op::minimum, Op::maximum, Op::select};
constexpr std::array analytic_steps = {Op::lt, Op::le, Op::floor, Op::sign};
constexpr std::array others = {Op::cbrt,  Op::exp2,  Op::expm1, Op::log1p,    Op::log2, Op::log10,
                               Op::acosh, Op::atan2, Op::hypot, Op::copysign, Op::mod,  Op::fmod};
constexpr std::array other_steps = {
    Op::ceil, Op::trunc, Op::rint,        Op::floor_divide, Op::gt,         Op::ge,
    Op::eq,   Op::ne,    Op::logical_and, Op::logical_or,   Op::logical_not};

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  RandomExpression make() {
    e_.variables = 1 + below(5);
    e_.steps.resize(e_.variables);
    e_.analytic = below(2) == 0;
    const std::size_t operations = 5 + below(35);
    for (std::size_t i = 0; i < operations; ++i) add_operation();
    const std::size_t outputs = 1 + below(5);
    for (std::size_t i = 0; i < outputs; ++i) e_.outputs.push_back(recent());
    e_.outputs.push_back(e_.steps.size() - 1);
    return std::move(e_);
  }

 private:
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  std::size_t add(Op op, std::size_t a, std::size_t b = 0, std::size_t c = 0) {
    e_.steps.push_back({op, {a, b, c}});
    return e_.steps.size() - 1;
  }
  std::size_t constant(double value) {
    e_.steps.push_back({Op::constant, {}, value});
    return e_.steps.size() - 1;
  }
  /// A number at hand, sometimes a new constant.
  std::size_t any() {
    if (below(6) == 0) return constant(0.25 * static_cast<double>(below(17)) - 2.0);
    return recent();
  }
  /// No constant, and often one of the last steps: most would lead nowhere.
  std::size_t recent() {
    const std::size_t size = e_.steps.size();
    std::size_t chosen = 0;
    do {
      chosen = below(2) == 0 ? below(size) : size - 1 - below(std::min<std::size_t>(size, 16));
    } while (chosen >= e_.variables && e_.steps[chosen].op == Op::constant);
    return chosen;
  }
  /// tanh of it: between -1 and 1.
  std::size_t small(std::size_t a) { return add(Op::tanh, a); }
  /// Between 1/2 and 3/2.
  std::size_t positive(std::size_t a) {
    return add(Op::add, constant(1.0), add(Op::mul, constant(0.5), small(a)));
  }
  /// None for which a graph takes products: these need not be std::pow's to the last bit.
  std::size_t exponent() {
    constexpr std::array all = {-3.0, -2.0, 0.0, 1.0, 1.5, 5.0};
    return constant(all[below(all.size())]);
  }

  template <class All>
  Op one_of(const All& all) {
    return all[below(all.size())];
  }
  Op operation() {
    const bool analytic_only = e_.analytic || below(2) == 0;
    if (below(10) == 0) return analytic_only ? one_of(analytic_steps) : one_of(other_steps);
    if (below(2) == 0) return one_of(plain);
    return analytic_only ? one_of(analytic) : one_of(others);
  }

  void add_operation() {
    const Op op = operation();
    const std::size_t a = any();
    switch (saltus::tape::operand_count(op)) {
      case 1:
        add(op, within(op, a));
        break;
      case 2:
        add_of_two(op, a, any());
        break;
      default:
        add(op, add(Op::lt, a, any()), any(), any());
    }
  }
  /// An operand for which `op` is defined, and small enough that the result is not large.
  std::size_t within(Op op, std::size_t a) {
    switch (op) {
      case Op::neg:
      case Op::abs:
      case Op::sin:
      case Op::cos:
      case Op::atan:
      case Op::tanh:
        return a;
      case Op::floor:
      case Op::ceil:
      case Op::trunc:
      case Op::rint:
      case Op::sign:
      case Op::asinh:
      case Op::logical_not:
        return a;
      case Op::acosh:
        return add(Op::add, constant(1.0), positive(a));
      case Op::asin:
      case Op::acos:
      case Op::atanh:
        return add(Op::mul, constant(0.75), small(a));
      default:
        return positive(a);
    }
  }
  void add_of_two(Op op, std::size_t a, std::size_t b) {
    switch (op) {
      case Op::mul:
        add(op, a, small(b));
        break;
      case Op::div:
      case Op::mod:
      case Op::fmod:
      case Op::floor_divide:
        add(op, a, positive(b));
        break;
      case Op::pow:
        add(op, positive(a), below(3) == 0 ? exponent() : small(b));
        break;
      case Op::atan2:
      case Op::hypot:
        add(op, a, positive(b));
        break;
      default:
        add(op, a, b);
    }
  }

  std::mt19937 random_;
  RandomExpression e_;
};

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
Real remainder(Real a, Real b) {  // with the sign of b
  const Real rest = std::fmod(a, b);
  if (rest == Real(0)) return std::copysign(Real(0), b);
  return (rest < Real(0)) != (b < Real(0)) ? rest + b : rest;
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
      if (b == Real(0)) return a / b;
      const Real rest = std::fmod(a, b);  // as Python's float.__floordiv__
      const Real whole = (a - rest) / b - (rest != Real(0) && (rest < Real(0)) != (b < Real(0)));
      if (whole == Real(0)) return std::copysign(Real(0), a / b);
      return std::floor(whole + Real(0.5));
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

RandomExpression random_expression(unsigned seed) { return Draw(seed).make(); }

std::vector<saltus::tape::Node> write(const RandomExpression& e, saltus::tape::Graph& graph) {
  std::vector<saltus::tape::Node> nodes;
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    const auto& s = e.steps[i];
    if (i < e.variables) {
      nodes.push_back(graph.continuous_state(static_cast<saltus::Index>(i)));
    } else if (s.op == Op::constant) {
      nodes.push_back(graph.constant(s.value));
    } else {
      std::vector<saltus::tape::Node> operands;
      for (int k = 0; k < saltus::tape::operand_count(s.op); ++k) {
        operands.push_back(nodes[s.from[static_cast<std::size_t>(k)]]);
      }
      nodes.push_back(graph.apply(s.op, operands));
    }
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
