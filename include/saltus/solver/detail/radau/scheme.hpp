// The Radau IIA methods by their number of stages.
#pragma once

#include <array>
#include <cmath>

#include "saltus/solver/detail/radau/tables.hpp"

namespace saltus::radau {

inline constexpr std::array stage_counts{3, 5, 7};
inline constexpr int most_stages = stage_counts.back();
inline constexpr int most_pairs = (most_stages - 1) / 2;

/// The table of one method, for code that does not depend on the number of stages at compile time.
struct Scheme {
  int stages;
  double gamma;
  const double *alpha, *beta;     // of the pairs of complex eigenvalues
  const double *c, *e, *weights;  // see RadauTable
  double dense_share;

  constexpr int pairs() const { return (stages - 1) / 2; }
  /// The error estimate, and the error of the collocation polynomial, shrink as h^estimate_order.
  constexpr double estimate_order() const { return stages + 1.0; }
  /// The local error shrinks as h^local_order.
  constexpr double local_order() const { return 2.0 * stages; }
};

template <int S>
constexpr Scheme as_scheme() {
  using Table = RadauTable<S>;
  return {S,        Table::gamma, Table::alpha,   Table::beta,
          Table::c, Table::e,     Table::weights, Table::dense_share};
}

/// The method with 3, 5 or 7 stages.
constexpr Scheme scheme_of(int stages) {
  return stages == 3 ? as_scheme<3>() : stages == 5 ? as_scheme<5>() : as_scheme<7>();
}

}  // namespace saltus::radau
