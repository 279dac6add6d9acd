// Functions that are known by their derivative.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

// The newest coefficient of a has a term of its own, so that nobody waits for the others.

/// r' = factor a' b.
struct Growth {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = i.factor * values[i.of_b];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.da, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, Index k) {
    const double a = rows[i.a + k];
    const double known = inner<slot>(rows + i.da, rows + i.b, own, k);
    rows[i.to + k] = known * (i.factor * inverse_of(k)) + own[8] * a;
    rows[i.da + k] = number(k) * a;
  }
};

/// s' = a' c, c' = factor a' s.
struct Rotation {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = i.factor * values[i.value];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.da, rows + i.to_second, k).store(own);
    earlier_product(rows + i.da, rows + i.to, k).store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    const double a = rows[i.a + k];
    const double with_c = inner<slot>(rows + i.da, rows + i.to_second, own, k);
    const double with_s = inner<slot>(rows + i.da, rows + i.to, own + 4, k);
    rows[i.to + k] = with_c * inverse_of(k) + values[i.of_b] * a;
    rows[i.to_second + k] = with_s * (i.factor * inverse_of(k)) + own[8] * a;
    rows[i.da + k] = number(k) * a;
  }
};

/// b r' = factor a'; if `ready`, the row of a' is given.
template <bool ready>
struct Logarithm {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = 1.0 / values[i.of_b];
    own[9] = i.factor * own[8];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.db, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, Index k) {
    const double known = inner<slot>(rows + i.db, rows + i.b, own, k) * (own[8] * inverse_of(k));
    const double of_a = ready ? rows[i.da + k] * (own[8] * inverse_of(k)) : own[9] * rows[i.a + k];
    rows[i.to + k] = of_a - known;
    rows[i.db + k] = number(k) * rows[i.to + k];
  }
};

/// b a' - a b'.
struct Turn {
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    const Four of_a = earlier_product(rows + i.b, rows + i.da, k);
    (of_a - earlier_product(rows + i.a, rows + i.db, k)).store(own);
    Four().store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    const double da = rows[i.da + k] = number(k) * rows[i.a + k];
    const double db = rows[i.db + k] = number(k) * rows[i.b + k];
    const double of_a = inner<slot>(rows + i.b, rows + i.da, own, k) + values[i.of_b] * da;
    const double of_b = inner<slot>(rows + i.a, rows + i.db, own + 4, k) + values[i.of_a] * db;
    rows[i.to + k] = of_a - of_b;
  }
};

}  // namespace

const Kernel growth = kernel<Growth>();
const Kernel rotation = kernel<Rotation>();
const Kernel logarithm = kernel<Logarithm<false>>();
const Kernel angle = kernel<Logarithm<true>>();
const Kernel turn = kernel<Turn>();

}  // namespace saltus::tape::series
