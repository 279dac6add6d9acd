// The order and the length of a Taylor step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/base/ids.hpp"
#include "saltus/solver/detail/taylor/tuning.hpp"
#include "saltus/tape/series.hpp"

namespace saltus::taylor {

inline constexpr int least_order = 4, most_order = tape::Series::highest_order;

/// The order that needs the fewest operations for a relative tolerance: their number grows with the
/// square of the order p, and a step is exp(-2) of the radius of convergence at p = 1 - ln(rtol)/2
/// (Jorba and Zou, 2005, section 3.1).
inline int order_of(double rtol) {
  const double best = 1.0 - 0.5 * std::log(std::max(rtol, std::numeric_limits<double>::epsilon()));
  return std::clamp(static_cast<int>(std::ceil(best)), least_order, most_order);
}

/// The largest |x_i^[k]| in tolerances of each state; `x` is row k.
template <class Tolerance>
double largest_term(Index n, const double* x, const Tolerance& tolerance) {
  double largest = 0.0;
  for (Index i = 0; i < n; ++i) largest = std::max(largest, std::abs(x[i]) / tolerance(i));
  return largest;
}

/// The length [s] at which a term of order k is one tolerance: infinite for a term that vanishes.
inline double reach(double term, int k) {
  return term > 0.0 ? std::pow(term, -1.0 / k) : std::numeric_limits<double>::infinity();
}

/// The length [s] of a step of order p. Each of the last two terms of the series is at most one
/// tolerance; the first term that is left out is then about exp(-2) tolerances. Two terms are
/// looked at, because every second term of an even or odd function is zero. If both are zero, the
/// highest term that is not decides instead, among those above order p/2. If all of these are zero,
/// the length is infinite: the polynomial is taken for the solution, and the check at the end of
/// the step confirms it. `term(k)` is the largest term of order k in tolerances, see
/// `largest_term`.
template <class Term>
double length_of(int p, const Term& term) {
  double h = std::min(reach(term(p), p), reach(term(p - 1), p - 1));
  for (int k = p - 2; !std::isfinite(h) && k > p / 2; --k) h = reach(term(k), k);
  return h;
}

/// The part of a step to try next after a check found this error, above 1 tolerance: the error is
/// of order p + 1.
inline double shorter(double error, int p) {
  if (!std::isfinite(error)) return tuning::shortest_retry;
  return std::max(tuning::shortest_retry, tuning::safety * std::pow(error, -1.0 / (p + 1)));
}

}  // namespace saltus::taylor
