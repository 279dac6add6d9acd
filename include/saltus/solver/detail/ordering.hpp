// An order of the states in which the places of a Jacobian are near the diagonal.
#pragma once

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// How far the places of a matrix reach below and above the diagonal.
struct Bandwidth {
  Index lower = 0, upper = 0;
  Index total() const { return lower + upper + 1; }
};

/// The bandwidth if state i has position[i]; in the natural order if `position` is empty.
Bandwidth bandwidth(const Sparsity& places, const std::vector<int>& position = {});

/// Positions by the reverse Cuthill-McKee order of the graph of the matrix and its transpose, each
/// component from a state far from its middle (E. Cuthill, J. McKee, "Reducing the bandwidth of
/// sparse symmetric matrices", Proc. 24th Nat. Conf. ACM, 1969, p. 157; reversed and started as in
/// A. George, J. W. H. Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981, ch.
/// 4). The time is linear in the number of places, except for the sorting of neighbours by degree.
std::vector<int> reverse_cuthill_mckee(const Sparsity& places);

}  // namespace saltus
