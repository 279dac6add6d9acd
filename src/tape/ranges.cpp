#include "saltus/tape/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "copy.hpp"

namespace saltus::tape {

namespace {

using std::numbers::pi;

/// Whether one of the places phase + 2 pi k is in a range.
bool has_place(const ValueRange& a, double phase) {
  const double turn = 2.0 * pi;
  return phase + turn * std::ceil((a.low - phase) / turn) <= a.high;
}

ValueRange sine_of(const ValueRange& a) {
  if (!(a.width() < 2.0 * pi)) return {-1.0, 1.0};
  const auto [low, high] = std::minmax({std::sin(a.low), std::sin(a.high)});
  return {has_place(a, -0.5 * pi) ? -1.0 : low, has_place(a, 0.5 * pi) ? 1.0 : high};
}

ValueRange magnitude_of(const ValueRange& a) {
  if (a.low >= 0.0) return a;
  if (a.high <= 0.0) return -a;
  return {0.0, std::max(-a.low, a.high)};
}

ValueRange quotient_of(const ValueRange& a, const ValueRange& b) {
  if (b.has_zero()) return {};
  return a * ValueRange{1.0 / b.high, 1.0 / b.low};
}

template <class F>
ValueRange rising(const ValueRange& a, F f) {
  return {f(a.low), f(a.high)};
}

/// The root of a negative number is NaN, which is in no bounds.
ValueRange root_of(const ValueRange& a) {
  if (!(a.low >= 0.0)) return {};
  return rising(a, [](double v) { return std::sqrt(v); });
}

ValueRange minimum_of(const ValueRange& a, const ValueRange& b) {
  return {std::min(a.low, b.low), std::min(a.high, b.high)};
}
ValueRange maximum_of(const ValueRange& a, const ValueRange& b) {
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

/// Both branches, unless the truth is known.
ValueRange choice_of(const ValueRange& truth, const ValueRange& a, const ValueRange& b) {
  if (!truth.has_zero()) return a;
  if (truth.low == 0.0 && truth.high == 0.0) return b;
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Whether a < b, or a <= b where `equal`, for all values, for none, or for some.
ValueRange less(const ValueRange& a, const ValueRange& b, bool equal) {
  if (equal ? a.high <= b.low : a.high < b.low) return {1.0, 1.0};
  if (equal ? a.low > b.high : a.low >= b.high) return {0.0, 0.0};
  return {0.0, 1.0};
}

ValueRange of_one(Op op, const ValueRange& a) {
  switch (op) {
    case Op::neg:
      return -a;
    case Op::abs:
      return magnitude_of(a);
    case Op::sqrt:
      return root_of(a);
    case Op::cbrt:
      return rising(a, [](double v) { return std::cbrt(v); });
    case Op::exp:
      return rising(a, [](double v) { return std::exp(v); });
    case Op::atan:
      return rising(a, [](double v) { return std::atan(v); });
    case Op::tanh:
      return rising(a, [](double v) { return std::tanh(v); });
    case Op::sin:
      return sine_of(a);
    case Op::cos:
      return sine_of(a + ValueRange{0.5 * pi, 0.5 * pi});
    case Op::floor:
      return rising(a, [](double v) { return std::floor(v); });
    case Op::ceil:
      return rising(a, [](double v) { return std::ceil(v); });
    case Op::sign:
      return rising(a, [](double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; });
    case Op::logical_not:
      return {0.0, 1.0};
    default:
      return {};
  }
}

ValueRange of_two(Op op, const ValueRange& a, const ValueRange& b, bool same) {
  switch (op) {
    case Op::add:
      return a + b;
    case Op::sub:
      return a + -b;
    case Op::mul:
      return same ? magnitude_of(a) * magnitude_of(a) : a * b;
    case Op::div:
      return quotient_of(a, b);
    case Op::minimum:
      return minimum_of(a, b);
    case Op::maximum:
      return maximum_of(a, b);
    case Op::lt:
      return less(a, b, false);
    case Op::le:
      return less(a, b, true);
    case Op::eq:
    case Op::ne:
    case Op::logical_and:
    case Op::logical_or:
      return {0.0, 1.0};
    default:
      return {};
  }
}

ValueRange of_state(double from, double to) {
  const double room = 0.5 * std::abs(to - from);
  return {std::min(from, to) - room, std::max(from, to) + room};
}

}  // namespace

Ranges::Ranges(const Graph& graph, std::span<const Node> outputs)
    : outputs_(copy(graph, outputs, graph_)) {
  for (int id = 0; id < graph_.size(); ++id)
    reads_state_ = reads_state_ || graph_[{id}].op == Op::continuous_state;
}

void Ranges::evaluate(const At& from, double to, const double* x_to,
                      List<ValueRange>& bounds) const {
  const auto fixed = [](double value) { return ValueRange{value, value}; };
  const auto of = [&](const Expression& e) -> ValueRange {
    const auto operand = [&](std::size_t k) { return bounds[e.operands[k].id]; };
    switch (e.op) {
      case Op::constant:
        return fixed(e.value);
      case Op::time:
        return {std::min(from.time, to), std::max(from.time, to)};
      case Op::continuous_state:
        return of_state(from.x[e.index], x_to[e.index]);
      case Op::discrete_state:
        return fixed(from.z[e.index]);
      case Op::parameter:
        return fixed(from.p[e.index]);
      case Op::input:
        return fixed(from.u[e.port][e.index]);
      case Op::select:
        return choice_of(operand(0), operand(1), operand(2));
      default:
        break;
    }
    if (operand_count(e.op) == 1) return of_one(e.op, operand(0));
    if (operand_count(e.op) == 2)
      return of_two(e.op, operand(0), operand(1), e.operands[0] == e.operands[1]);
    return {};
  };
  bounds.resize(graph_.size());
  for (int id = 0; id < graph_.size(); ++id) bounds[id] = of(graph_[{id}]);
}

}  // namespace saltus::tape
