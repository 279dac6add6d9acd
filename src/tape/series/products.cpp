// Products, quotients, roots and powers.
#include <cmath>

#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

struct Product {
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.a, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double *a = rows + i.a, *b = rows + i.b;
    rows[i.to + k] = inner<slot>(a, b, own, k) + (values[i.of_a] * b[k] + values[i.of_b] * a[k]);
  }
};

struct Square {
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_square(rows + i.a, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double* a = rows + i.a;
    rows[i.to + k] = inner_square<slot>(a, own, k) + 2.0 * (values[i.of_a] * a[k]);
  }
};

/// r b = a, or a multiple of it.
struct Quotient {
  static void begin(const Instruction& i, double*, double* own, const double* values, int) {
    own[8] = 1.0 / values[i.of_b];
  }
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.b, rows + i.to, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double *b = rows + i.b, *r = rows + i.to;
    const double known = values[i.of_a] * rows[i.a + k] - inner<slot>(b, r, own, k);
    rows[i.to + k] = (known - values[i.value] * b[k]) * own[8];
  }
};

/// r r = a.
struct Root {
  static void begin(const Instruction& i, double*, double* own, const double* values, int) {
    own[8] = 0.5 / values[i.value];
  }
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_square(rows + i.to, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, int k) {
    rows[i.to + k] = (rows[i.a + k] - inner_square<slot>(rows + i.to, own, k)) * own[8];
  }
};

/// a r' = p a' r with the constant p.
struct Power {
  static void begin(const Instruction& i, double*, double* own, const double* values, int) {
    own[8] = 1.0 / values[i.of_a];
  }
  static void earlier(const Instruction& i, double* rows, double* own, const double*, int k) {
    earlier_product(rows + i.to, rows + i.da, k).store(own);
    earlier_product(rows + i.db, rows + i.a, k).store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values, int k) {
    const double *a = rows + i.a, *r = rows + i.to, *da = rows + i.da, *dr = rows + i.db;
    const double p = values[i.of_b];
    rows[i.da + k] = k * a[k];
    if (values[i.of_a] == 0.0) {
      rows[i.to + k] = at_zero(a, r, p, k);
    } else {
      const double of_da = inner<slot>(r, da, own, k) + values[i.value] * da[k];
      rows[i.to + k] = (p * of_da - inner<slot>(dr, a, own + 4, k)) * (own[8] * inverse_of(k));
    }
    rows[i.db + k] = k * rows[i.to + k];
  }

  /// The first coefficient of a that is not 0 has order m: a = s^m u with u_0 = a_m, and r = s^(m p)
  /// times a power of u, if m p is a whole number.
  static double at_zero(const double* a, const double* r, double p, int k) {
    int m = 1;
    while (m <= k && a[m] == 0.0) ++m;
    const double lowest = m * p;
    if (p < 0.0 || std::floor(lowest) != lowest) return std::nan("");
    if (m > k || k < lowest) return 0.0;
    const int n = static_cast<int>(lowest);
    if (k == n) return std::pow(a[m], p);
    double sum = 0.0;
    for (int j = 0; j < k - n; ++j)
      sum += ((k - n) * p - j * (p + 1.0)) * a[m + k - n - j] * r[n + j];
    return sum / ((k - n) * a[m]);
  }
};

}  // namespace

const Kernel product = kernel<Product>();
const Kernel square = kernel<Square>();
const Kernel quotient = kernel<Quotient>();
const Kernel root = kernel<Root>();
const Kernel power = kernel<Power>();

}  // namespace saltus::tape::series
