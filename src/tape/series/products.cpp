// Products, quotients, roots and powers.
#include <cmath>

#include "kernel.hpp"

namespace saltus::tape::series {

namespace {

struct Product {
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.a, rows + i.b, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    const double *a = rows + i.a, *b = rows + i.b;
    const double known = inner<slot>(a, b, own, k) + values[i.of_b] * a[k];
    rows[i.to + k] = known + values[i.of_a] * b[k];  // b is the later one of both
  }
};

struct Square {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = 2.0 * values[i.of_a];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_square(rows + i.a, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, Index k) {
    const double* a = rows + i.a;
    rows[i.to + k] = inner_square<slot>(a, own, k) + own[8] * a[k];
  }
};

/// r b = a, or a multiple of it.
struct Quotient {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = 1.0 / values[i.of_b];
    own[9] = values[i.value] * own[8];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.b, rows + i.to, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    const double *b = rows + i.b, *r = rows + i.to;
    const double known = values[i.of_a] * rows[i.a + k] - inner<slot>(b, r, own, k);
    rows[i.to + k] = known * own[8] - own[9] * b[k];
  }
};

/// r r = a.
struct Root {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = 0.5 / values[i.value];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_square(rows + i.to, k).store(own);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double*, Index k) {
    rows[i.to + k] = (rows[i.a + k] - inner_square<slot>(rows + i.to, own, k)) * own[8];
  }
};

/// a r' = p a' r with the constant p.
struct Power {
  static void begin(const Instruction& i, double* own, const double* values) {
    own[8] = 1.0 / values[i.of_a];
    own[9] = values[i.of_b] * values[i.value] * own[8];
  }
  static void earlier(const Instruction& i, double* rows, double* own, Index k) {
    earlier_product(rows + i.to, rows + i.da, k).store(own);
    earlier_product(rows + i.db, rows + i.a, k).store(own + 4);
  }
  template <int slot>
  static void order(const Instruction& i, double* rows, double* own, const double* values,
                    Index k) {
    const double *a = rows + i.a, *r = rows + i.to, *da = rows + i.da, *dr = rows + i.db;
    const double p = values[i.of_b];
    if (values[i.of_a] == 0.0) {
      rows[i.to + k] = at_zero(a, r, p, k);
    } else {
      const double known = p * inner<slot>(r, da, own, k) - inner<slot>(dr, a, own + 4, k);
      rows[i.to + k] = known * (own[8] * inverse_of(k)) + own[9] * a[k];
    }
    rows[i.da + k] = number(k) * a[k];
    rows[i.db + k] = number(k) * rows[i.to + k];
  }

  /// The first coefficient of a that is not 0 has order m: a = s^m u with u_0 = a_m, and r = s^(m p)
  /// times a power of u, if m p is a whole number.
  static double at_zero(const double* a, const double* r, double p, Index k) {
    Index m = 1;
    while (m <= k && a[m] == 0.0) ++m;
    const double lowest = number(m) * p;
    if (p < 0.0 || std::floor(lowest) != lowest) return std::nan("");
    if (m > k || number(k) < lowest) return 0.0;
    const Index n = static_cast<Index>(lowest), l = k - n;
    if (l == 0) return std::pow(a[m], p);
    double sum = 0.0;
    for (Index j = 0; j < l; ++j) {
      sum += (number(l) * p - number(j) * (p + 1.0)) * a[m + l - j] * r[n + j];
    }
    return sum / (number(l) * a[m]);
  }
};

}  // namespace

const Kernel product = kernel<Product>();
const Kernel square = kernel<Square>();
const Kernel quotient = kernel<Quotient>();
const Kernel root = kernel<Root>();
const Kernel power = kernel<Power>();

}  // namespace saltus::tape::series
