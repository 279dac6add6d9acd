#include <algorithm>
#include <random>

#include "support/expressions.hpp"

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
  /// A step that is no constant, and often one of the last steps; otherwise the output would not
  /// read most steps.
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
  /// Not an exponent for which a graph uses products, which may differ from std::pow in the last
  /// bit.
  std::size_t exponent() {
    constexpr std::array all = {-4.0, -2.3, 0.0, 1.0, 3.5, 5.0};
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

}  // namespace

RandomExpression random_expression(unsigned seed) { return Draw(seed).make(); }

}  // namespace support
