// Pieces: a known answer made of closed forms, one from each event to the next. They are joined at
// roots found in extended precision.
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

using Real = long double;  ///< the type of closed forms, whose own rounding then does not show

/// Closed forms in order: piece n is valid after n events. `Piece` has the members `Real begin` and
/// `Eigen::VectorXd state(Real t) const`, which also accepts times outside the piece.
template <class Piece>
struct ExactPieces {
  std::vector<Piece> pieces = {};            ///< one at least
  std::vector<double> times = {};            ///< [s] of the events
  double accumulation = EventSeries::never;  ///< [s] of the events, where they do
  Eigen::VectorXd rest = {};                 ///< the state from there on
};

/// The known answer for a scene in which only `guard` has events.
template <class Piece>
Exact pieces_answer(std::string provenance, std::string guard, ExactPieces<Piece> all) {
  const auto known = std::make_shared<const ExactPieces<Piece>>(std::move(all));
  return {.provenance = std::move(provenance),
          .events = {{std::move(guard), {{known->times, known->accumulation}}}},
          .state = [known](double t, const Branch& branch) -> Eigen::VectorXd {
            if (branch.rest) return known->rest;
            return known->pieces[std::min(branch.events, known->pieces.size() - 1)].state(t);
          }};
}

/// The root of f between a and b, where its signs differ, to the last bit, by bisection.
template <class Function>
Real root_between(const Function& f, Real a, Real b) {
  const bool above = f(a) > 0;
  for (;;) {
    const Real middle = a + (b - a) / 2;
    if (middle <= a || middle >= b) return b;
    (f(middle) > 0) == above ? a = middle : b = middle;
  }
}

/// The first root of f after `begin`, searched in equal steps; no value if there is none before
/// `end`. The sign of f one step after `begin` is the sign before the root.
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
