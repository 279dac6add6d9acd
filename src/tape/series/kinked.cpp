// Operations with branches. own[8] is the branch; 0 while the coefficients so far do not decide.
#include <cmath>

#include "../arithmetic.hpp"
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

struct Magnitude {
  static void begin(Start<double> s) {
    const auto& [i, own, values] = s;
    own[8] = detail::sign(values[i.of_a]);
    own[9] = i.op == Op::copysign ? std::copysign(1.0, values[i.of_b]) : 1.0;
  }
  template <int slot>
  static void order(Work<double> w) {
    const auto& [i, rows, own, k] = w;
    const double a = rows[i.a + k];
    if (own[8] == 0.0) own[8] = detail::sign(a);
    rows[i.to + k] = own[8] * own[9] * a;
  }
};

/// Whether a is the minimum (factor 1) or the maximum (factor -1): 1 or -1, or 0 if both are equal.
inline double first_is_chosen(double a, double b, double factor) {
  return a == b ? 0.0 : std::isnan(a) || factor * a < factor * b ? 1.0 : -1.0;
}

struct Extreme {
  static void begin(Start<double> s) {
    const auto& [i, own, values] = s;
    own[8] = first_is_chosen(values[i.of_a], values[i.of_b], i.factor);
  }
  template <int slot>
  static void order(Work<double> w) {
    const auto& [i, rows, own, k] = w;
    const double a = rows[i.a + k], b = rows[i.b + k];
    if (own[8] == 0.0) own[8] = first_is_chosen(a, b, i.factor);
    rows[i.to + k] = own[8] < 0.0 ? b : a;
  }
};

/// The condition compares c with d, if `op` is a comparison; otherwise it is the value of c.
struct Choice {
  static void begin(Start<double> s) {
    const auto& [i, own, values] = s;
    const bool open = i.op != Op::constant && values[i.of_c] == values[i.of_d] &&
                      values[i.of_a] == values[i.of_b];
    own[9] = truth(i, values[i.of_c], values[i.of_d]);
    own[8] = open ? 0.0 : own[9];
  }
  template <int slot>
  static void order(Work<double> w) {
    const auto& [i, rows, own, k] = w;
    const double c = rows[i.c + k], d = rows[i.d + k];
    if (own[8] == 0.0 && !(c == d)) own[8] = truth(i, c, d);
    rows[i.to + k] = (own[8] == 0.0 ? own[9] : own[8]) > 0.0 ? rows[i.a + k] : rows[i.b + k];
  }
  static double truth(const Instruction& i, double c, double d) {
    return (i.op == Op::constant ? c : compute(i.op, c, d, 0.0)) != 0.0 ? 1.0 : -1.0;
  }
};

/// Writes a choice whose condition is constant in time.
void write_choice(SeriesWriter& writer, const Instruction& i, Index, Index k) {
  const WrittenNumbers rows{&writer, Memory::rows, k};
  const std::array<Written, 2> compared{writer.value(i.of_c), writer.value(i.of_d)};
  const Written condition = i.op == Op::constant ? compared[0] : writer.apply(i.op, compared);
  const std::array<Written, 3> operands{condition, rows[i.a], rows[i.b]};
  writer.store(Memory::rows, i.to + k, writer.apply(Op::select, operands));
}

struct Remainder {
  static void begin(Start<double> s) {
    const auto& [i, own, values] = s;
    own[8] = std::nearbyint((values[i.of_a] - values[i.value]) / values[i.of_b]);
  }
  template <int slot>
  static void order(Work<double> w) {
    const auto& [i, rows, own, k] = w;
    rows[i.to + k] = rows[i.a + k] - own[8] * rows[i.b + k];
  }
};

}  // namespace

const Kernel magnitude = {handlers<Magnitude, double>(), {}, {}};
const Kernel extreme = {handlers<Extreme, double>(), {}, {}};
const Kernel choice = {handlers<Choice, double>(), {}, {}, all_written(&write_choice)};
const Kernel remainder = {handlers<Remainder, double>(), {}, {}};

}  // namespace saltus::tape::series
