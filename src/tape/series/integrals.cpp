// Functions that are known by their derivative.
#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

/// r' = factor a' b.
struct Growth {
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.da, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double da = rows[i.da + k] = k * rows[i.a + k];
    const double known = inner<slot>(rows + i.da, rows + i.b, own, k);
    rows[i.to + k] = (known + da * values[i.of_b]) * (i.factor * inverse_of(k));
  }
};

/// s' = a' c, c' = factor a' s.
struct Rotation {
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.da, rows + i.to_second, k).store(own);
    earlier_product(rows + i.da, rows + i.to, k).store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double da = rows[i.da + k] = k * rows[i.a + k];
    const double with_c = inner<slot>(rows + i.da, rows + i.to_second, own, k);
    const double with_s = inner<slot>(rows + i.da, rows + i.to, own + 4, k);
    rows[i.to + k] = (with_c + da * values[i.of_b]) * inverse_of(k);
    rows[i.to_second + k] = (with_s + da * values[i.value]) * (i.factor * inverse_of(k));
  }
};

/// b r' = factor a', or k times it in a row.
template <bool ready>
struct Logarithm {
  static void begin(const Instruction& i, double*, double* own, const double* values, int) {
    own[8] = 1.0 / values[i.of_b];
  }
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.db, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, int k) {
    const double da = ready ? rows[i.da + k] : i.factor * (k * rows[i.a + k]);
    const double dr = (da - inner<slot>(rows + i.db, rows + i.b, own, k)) * own[8];
    rows[i.db + k] = dr;
    rows[i.to + k] = dr * inverse_of(k);
  }
};

/// b a' - a b'.
struct Turn {
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    const Four of_a = earlier_product(rows + i.b, rows + i.da, k);
    (of_a - earlier_product(rows + i.a, rows + i.db, k)).store(own);
    Four().store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double da = rows[i.da + k] = k * rows[i.a + k];
    const double db = rows[i.db + k] = k * rows[i.b + k];
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
