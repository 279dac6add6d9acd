// Root separation: points between which a polynomial has at most one crossing of zero.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/solver/detail/taylor/step_rule.hpp"

namespace saltus::taylor {

/// The coefficients of a polynomial in the Bernstein basis of an interval. The number of their
/// changes of sign is at least the number of roots in the interval, and is equal to it if it is 0
/// or 1 (Descartes' rule; G. E. Collins, A. G. Akritas, "Polynomial real root isolation using
/// Descartes' rule of signs", SYMSAC 1976, 272; in this basis: J. M. Lane, R. F. Riesenfeld, BIT 21
/// (1981) 112).
struct Bernstein {
  std::array<double, most_order + 1> b{};
  int degree = 0;
  double from = 0.0, to = 1.0;

  /// Of sum_i a_i s^i for s in [0, 1].
  static Bernstein of(const double* a, int degree) {
    Bernstein out;
    out.degree = degree;
    double choose = 1.0;  // degree over i
    for (int i = 0; i <= degree; ++i) {
      out[i] = a[i] / choose;
      choose *= static_cast<double>(degree - i) / (i + 1);
    }
    for (int round = 1; round <= degree; ++round)
      for (int j = degree; j >= round; --j) out[j] += out[j - 1];
    return out;
  }

  double& operator[](int j) { return b[static_cast<std::size_t>(j)]; }
  double operator[](int j) const { return b[static_cast<std::size_t>(j)]; }

  /// The number of changes of sign in the list of coefficients, without those of at most `margin`.
  /// Counting stops at 2.
  int variations(double margin) const {
    int changes = 0, sign = 0;
    for (int j = 0; j <= degree && changes < 2; ++j) {
      const int now = (*this)[j] > margin ? 1 : (*this)[j] < -margin ? -1 : 0;
      if (now != 0 && sign != 0 && now != sign) ++changes;
      if (now != 0) sign = now;
    }
    return changes;
  }

  /// At least the number of roots in the interval. A root at an end counts too, so each root at a
  /// cut is counted in both parts.
  int crossings(double margin) const {
    const bool begins = std::abs((*this)[0]) <= margin, ends = std::abs((*this)[degree]) <= margin;
    return variations(margin) + static_cast<int>(begins) + static_cast<int>(ends);
  }

  /// Cuts the interval in its middle (de Casteljau): this becomes the first half; returns the
  /// second.
  Bernstein cut() {
    Bernstein second;
    second.degree = degree;
    const double middle = 0.5 * (from + to);
    second.from = middle, second.to = to, to = middle;
    for (int k = 0; k <= degree; ++k) {
      second[degree - k] = (*this)[degree];
      for (int j = degree; j > k; --j) (*this)[j] = 0.5 * ((*this)[j - 1] + (*this)[j]);
    }
    return second;
  }

  /// Where the coefficients are nearest to zero inside the interval; negative if none of them is
  /// within the margin.
  double touch(double margin) const {
    int nearest = 0;
    for (int j = 1; j < degree; ++j)
      if (std::abs((*this)[j]) <= margin &&
          (nearest == 0 || std::abs((*this)[j]) < std::abs((*this)[nearest])))
        nearest = j;
    return nearest == 0 ? -1.0 : from + (to - from) * nearest / degree;
  }
};

/// Finds the points at which a search has to look, so that a guard has at most one crossing between
/// two of them. It decides nothing: at its points the guard itself is evaluated.
class RootSeparation {
 public:
  /// Adds to `points`, as parts of a step, those between two crossings of `a` in [from, 1], where
  /// the guard is sum_i a_i s^i and s is the part of the step. False if the polynomial does not
  /// show its roots: its later terms are not small, or it has too many.
  bool separate(const double* a, int degree, double from, std::vector<double>& points) {
    double sum = 0.0, late = 0.0;
    for (int i = 1; i <= degree; ++i) {
      sum += std::abs(a[i]);
      if (2 * i > degree + 1) late += std::abs(a[i]);
    }
    if (!std::isfinite(sum + a[0]) || late > tuning::poor * sum) return false;
    const double margin = tuning::term_roundings * degree * std::numeric_limits<double>::epsilon() *
                              (sum + std::abs(a[0])) +
                          std::abs(a[degree]) * (degree > 1 ? 1.0 : 0.0);
    if (std::abs(a[0]) > sum + margin || sum <= margin) return true;  // it does not reach zero
    const Bernstein whole = Bernstein::of(a, degree);
    if (whole.crossings(margin) == 1 && std::abs(a[0]) > margin) return true;
    return isolate(whole, from, margin, points);
  }

 private:
  bool isolate(const Bernstein& whole, double from, double margin, std::vector<double>& points) {
    waiting_.assign(1, whole);
    int cuts = 0;
    bool before = false;  // there is a crossing before the next part
    while (!waiting_.empty()) {
      Bernstein part = waiting_.back();
      waiting_.pop_back();
      if (part.to <= from) continue;
      if (part.crossings(margin) > 1 && part.to - part.from > tuning::shortest_part) {
        if (++cuts > tuning::most_cuts) return false;
        Bernstein second = part.cut();
        waiting_.push_back(second), waiting_.push_back(part);
        continue;
      }
      add(part, margin, before, from, points);
    }
    return true;
  }
  /// Adds a point between the crossing of this part and the one before, and one at a touch.
  static void add(const Bernstein& part, double margin, bool& before, double from,
                  std::vector<double>& points) {
    const int crossings = part.crossings(margin);
    const double touch = crossings > 1   ? 0.5 * (part.from + part.to)
                         : crossings > 0 ? -1.0
                                         : part.touch(margin);
    if (touch > from) points.push_back(touch);
    const bool crosses = crossings > 0 || touch >= 0.0;
    const bool begins = std::abs(part[0]) <= margin;  // a crossing or a touch: the guard says which
    if ((begins || (before && crosses)) && part.from > from) points.push_back(part.from);
    before = before || crosses;
  }

  std::vector<Bernstein> waiting_;
};

}  // namespace saltus::taylor
