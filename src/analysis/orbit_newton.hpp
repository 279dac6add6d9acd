// Newton's method for F(u) = 0, damped where the full step leaves the domain or does not help.
#pragma once

#include "closing.hpp"
#include "saltus/analysis/free_value.hpp"

namespace saltus {

/// Where the search ended.
struct OrbitFound {
  Arc arc;
  SearchStatus status = SearchStatus::converged;
  std::string message = {};
  int iterations = 0;
};

/// Newton's method from the unknowns of `closing`, with the monotonicity test in units of the Newton
/// step: |F'^-1 F(u + c d)| <= (1 - c/4) |d| (P. Deuflhard, Newton Methods for Nonlinear Problems,
/// Springer 2004, section 3.3).
OrbitFound search_orbit(Closing& closing, double tolerance, int most);

}  // namespace saltus
