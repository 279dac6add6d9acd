// Products, quotients, roots and powers. The newest coefficient of an operand has a term of its
// own, so that the others are summed before it is known.
#include <cmath>

#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

struct Product : OfTwo {
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.a, w.i.b);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const Row<N> a = w.row(w.i.a), b = w.row(w.i.b);
    const N known = inner<slot>(a, b, w.sums(), w.k) + w.kept(1) * a[w.k];
    w.set(w.i.to, known + w.kept(0) * b[w.k]);  // b is the operand that is known later
  }
};

struct Square {
  template <class N>
  static void begin(Start<N> s) {
    s.keep(0, 2.0 * s.value(&Instruction::of_a));
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier_square(w.i.a);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const Row<N> a = w.row(w.i.a);
    w.set(w.i.to, inner_square<slot>(a, w.sums(), w.k) + w.kept(0) * a[w.k]);
  }
};

/// r b = a, or a multiple of a.
struct Quotient {
  template <class N>
  static void begin(Start<N> s) {
    const N inverse = 1.0 / s.value(&Instruction::of_b);
    s.keep(0, inverse);
    s.keep(1, inverse * s.value(&Instruction::value));
    s.keep(2, s.value(&Instruction::of_a));
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.b, w.i.to);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const Row<N> b = w.row(w.i.b), r = w.row(w.i.to);
    const N known = w.kept(2) * w.newest() - inner<slot>(b, r, w.sums(), w.k);
    w.set(w.i.to, known * w.kept(0) - w.kept(1) * b[w.k]);
  }
};

/// r r = a.
struct Root {
  template <class N>
  static void begin(Start<N> s) {
    s.keep(0, 0.5 / s.value(&Instruction::value));
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier_square(w.i.to);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const N known = inner_square<slot>(w.row(w.i.to), w.sums(), w.k);
    w.set(w.i.to, (w.newest() - known) * w.kept(0));
  }
};

void leave_if_zero(double) {}
void leave_if_zero(const Four&) {}
void leave_if_zero(const Written& a) { a.writer->leave_if_zero(a); }

/// The power of a whose value is 0. The first coefficient of a that is not 0 has order m: a = s^m u
/// with u_0 = a_m, and r = s^(m p) times a power of u, if m p is a whole number.
template <class At>
double power_at_zero(At a, At r, double p, Index k) {
  Index m = 1;
  while (m <= k && a(m) == 0.0) ++m;
  const double lowest = number(m) * p;
  if (p < 0.0 || std::floor(lowest) != lowest) return std::nan("");
  if (m > k || number(k) < lowest) return 0.0;
  const Index n = static_cast<Index>(lowest), l = k - n;
  if (l == 0) return std::pow(a(m), p);
  double sum = 0.0;
  for (Index j = 0; j < l; ++j) {
    sum += (number(l) * p - number(j) * (p + 1.0)) * a(m + l - j) * r(n + j);
  }
  return sum / (number(l) * a(m));
}

/// a r' = p a' r with the constant p.
struct Power {
  template <class N>
  static void begin(Start<N> s) {
    const N base = s.value(&Instruction::of_a), p = s.value(&Instruction::of_b);
    const N inverse = 1.0 / base;
    s.keep(0, inverse);
    s.keep(1, p * s.value(&Instruction::value) * inverse);
    s.keep(2, p);
    s.keep(3, base);
    leave_if_zero(base);
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.to, w.i.da);
    w.add_second(w.i.db, w.i.a);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const Row<N> a = w.row(w.i.a), r = w.row(w.i.to), da = w.row(w.i.da), dr = w.row(w.i.db);
    const N known =
        w.kept(2) * inner<slot>(r, da, w.sums(), w.k) - inner<slot>(dr, a, w.second_sums(), w.k);
    w.set(w.i.to, known * (inverse_of(w.k) * w.kept(0)) + w.kept(1) * a[w.k]);
    repair(w);
    w.set(w.i.da, number(w.k) * a[w.k]);
    w.set(w.i.db, number(w.k) * r[w.k]);
  }
  /// Where the base is 0, there is another recurrence.
  template <class N>
  static void repair(Work<N> w) {
    constexpr Index n = width<N>;
    for (Index l = 0; l < n; ++l) {
      if (w.own[11 * n + l] != 0.0) continue;
      const auto at = [&](Index row) {
        return [p = w.rows + row + l](Index k) { return p[width<N> * k]; };
      };
      w.rows[w.i.to + n * w.k + l] = power_at_zero(at(w.i.a), at(w.i.to), w.own[10 * n + l], w.k);
    }
  }
  /// Machine code has left before.
  static void repair(const Work<Written>&) {}
};

}  // namespace

const Kernel product = kernel<Product>({.a = true, .b = true});
const Kernel square = kernel<Square>({.a = true});
const Kernel quotient = kernel<Quotient>({.b = true});
const Kernel root = kernel<Root>({});
const Kernel power = kernel<Power>({.a = true, .da = true, .db = true});

}  // namespace saltus::tape::series
