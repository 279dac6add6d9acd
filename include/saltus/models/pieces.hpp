// Pieces: a known answer made of closed forms, one from each event to the next, joined at roots
// that are found in extended precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "saltus/base/error.hpp"
#include "saltus/report/exact.hpp"

namespace saltus::models {

using Real = long double;  ///< of closed forms, so that no rounding of their own shows

/// Closed forms one after the other: piece n holds behind n events. `Piece` has the members
/// `Real begin` and `Eigen::VectorXd state(Real t) const`, good for times outside the piece too.
template <class Piece>
struct Pieces {
  std::vector<Piece> pieces = {};            ///< one at least
  std::vector<double> times = {};            ///< [s] of the events
  double accumulation = EventSeries::never;  ///< [s] of the events, where they do
  Eigen::VectorXd rest = {};                 ///< the state from there on
};

/// The known answer for a scene whose events are those of `guard`.
template <class Piece>
Exact pieces_answer(std::string provenance, std::string guard, Pieces<Piece> all) {
  const auto known = std::make_shared<const Pieces<Piece>>(std::move(all));
  return {.provenance = std::move(provenance),
          .events = {{std::move(guard), {{known->times, known->accumulation}}}},
          .state = [known](double t, const Branch& branch) -> Eigen::VectorXd {
            if (branch.rest) return known->rest;
            return known->pieces[std::min(branch.events, known->pieces.size() - 1)].state(t);
          }};
}

/// The root of f between a and b, where its signs differ, to the last bit: bisection.
template <class Function>
Real root_between(const Function& f, Real a, Real b) {
  const bool above = f(a) > 0;
  for (;;) {
    const Real middle = a + (b - a) / 2;
    if (middle <= a || middle >= b) return b;
    (f(middle) > 0) == above ? a = middle : b = middle;
  }
}

/// The first root of f after `begin`, looked for in strides; none before `end`. The sign of f one
/// stride after `begin` is the one that it leaves.
template <class Function>
std::optional<Real> first_root(const Function& f, Real begin, Real stride, Real end) {
  const bool above = f(begin + stride) > 0;
  for (Real a = begin + stride; a < end; a += stride) {
    if ((f(a + stride) > 0) != above) return root_between(f, a, a + stride);
  }
  return {};
}

/// Throws ModelError unless a parameter of a scene makes sense.
inline void insist(bool good, std::string_view scene, std::string_view expected, double found) {
  if (!good) throw ModelError(text(scene, ": expected ", expected, ", found ", found));
}

}  // namespace saltus::models
