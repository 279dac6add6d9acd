// Quantiles of Student's and of the normal distribution.
#include "student.hpp"

#include <cmath>
#include <limits>

namespace saltus {

namespace {

/// The continued fraction of the incomplete beta function I_x(a, b), by Lentz's method.
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300, enough = 1e-16;
  const auto kept = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1.0, d = 1.0 / kept(1.0 - (a + b) * x / (a + 1.0)), h = d;
  for (int m = 1; m < 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / kept(1.0 + even * d), c = kept(1.0 + even / c), h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / kept(1.0 + odd * d), c = kept(1.0 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1.0) < enough) break;
  }
  return h;
}

/// I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

/// P(T > t) for t >= 0.
double upper_tail(double freedom, double t) {
  if (std::isinf(freedom)) return 0.5 * std::erfc(t / std::sqrt(2.0));
  return 0.5 * incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

}  // namespace

double student_quantile(double freedom, double probability) {
  if (probability < 0.5) return -student_quantile(freedom, 1.0 - probability);
  const double tail = 1.0 - probability;
  double low = 0.0, high = 1.0;
  while (upper_tail(freedom, high) > tail && high < 1e300) low = high, high *= 2.0;
  for (int i = 0; i < 200 && high - low > std::numeric_limits<double>::epsilon() * high; ++i) {
    const double middle = 0.5 * (low + high);
    (upper_tail(freedom, middle) > tail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace saltus
