// Functions that are known by their derivative. The newest coefficient of an operand has a term of
// its own, so that the others are summed before it is known.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

/// r' = factor a' b.
struct Growth {
  template <class N>
  static void begin(Start<N> s) {
    s.keep(0, s.i.factor * s.value(&Instruction::of_b));
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.da, w.i.b);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const N a = w.newest();
    const N known = inner<slot>(w.row(w.i.da), w.row(w.i.b), w.sums(), w.k);
    w.set(w.i.to, (w.i.factor * inverse_of(w.k)) * known + w.kept(0) * a);
    w.set(w.i.da, number(w.k) * a);
  }
};

/// s' = a' c, c' = factor a' s.
struct Rotation {
  template <class N>
  static void begin(Start<N> s) {
    s.keep(0, s.value(&Instruction::of_b));
    s.keep(1, s.i.factor * s.value(&Instruction::value));
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.da, w.i.to_second);
    w.add_second(w.i.da, w.i.to);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const N a = w.newest();
    const Row<N> da = w.row(w.i.da);
    const N with_c = inner<slot>(da, w.row(w.i.to_second), w.sums(), w.k);
    const N with_s = inner<slot>(da, w.row(w.i.to), w.second_sums(), w.k);
    w.set(w.i.to, inverse_of(w.k) * with_c + w.kept(0) * a);
    w.set(w.i.to_second, (w.i.factor * inverse_of(w.k)) * with_s + w.kept(1) * a);
    w.set(w.i.da, number(w.k) * a);
  }
};

/// b r' = factor a'. If `ready`, row a already holds k times the coefficients.
template <bool ready>
struct Logarithm {
  template <class N>
  static void begin(Start<N> s) {
    const N inverse = 1.0 / s.value(&Instruction::of_b);
    s.keep(0, inverse);
    s.keep(1, s.i.factor * inverse);
  }
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.db, w.i.b);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const N share = inverse_of(w.k) * w.kept(0);
    const N known = inner<slot>(w.row(w.i.db), w.row(w.i.b), w.sums(), w.k) * share;
    const N result = (ready ? share : w.kept(1)) * w.newest() - known;
    w.set(w.i.to, result);
    w.set(w.i.db, number(w.k) * result);
  }
};

/// b a' - a b'.
struct Turn : OfTwo {
  template <class N>
  static void earlier(Work<N> w) {
    w.add_earlier(w.i.b, w.i.da);
    w.add_second(w.i.a, w.i.db);
  }
  template <int slot, class N>
  static void order(Work<N> w) {
    const Row<N> a = w.row(w.i.a), b = w.row(w.i.b);
    const N da = number(w.k) * a[w.k], db = number(w.k) * b[w.k];
    w.set(w.i.da, da);
    w.set(w.i.db, db);
    const N of_a = inner<slot>(b, w.row(w.i.da), w.sums(), w.k) + w.kept(1) * da;
    w.set(w.i.to, of_a - inner<slot>(a, w.row(w.i.db), w.second_sums(), w.k) - w.kept(0) * db);
  }
};

}  // namespace

const Kernel growth = kernel<Growth>({.b = true, .da = true});
const Kernel rotation = kernel<Rotation>({.da = true, .second = true});
const Kernel logarithm = kernel<Logarithm<false>>({.b = true, .db = true});
const Kernel angle = kernel<Logarithm<true>>({.b = true, .db = true});
const Kernel turn = kernel<Turn>({.a = true, .b = true, .da = true, .db = true});

}  // namespace saltus::tape::series
