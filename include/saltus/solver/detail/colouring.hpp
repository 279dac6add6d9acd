// Columns of a Jacobian that one difference can find together.
#pragma once

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// Columns by colour: those of colour c are columns[start[c]] to columns[start[c + 1] - 1].
struct Colouring {
  std::vector<Index> start = {0};
  std::vector<int> columns;

  Index colours() const { return static_cast<Index>(start.size()) - 1; }
  std::span<const int> of(Index colour) const {
    const auto first = static_cast<std::size_t>(start[static_cast<std::size_t>(colour)]);
    return {columns.data() + first,
            static_cast<std::size_t>(start[static_cast<std::size_t>(colour) + 1]) - first};
  }
};

/// Colours the columns that differences have to find, so that in no row that they have to find do
/// two columns of one colour meet: then one call with all of them moved tells them apart (A. R.
/// Curtis, M. J. D. Powell, J. K. Reid, "On the estimation of sparse Jacobian matrices", IMA J.
/// Appl. Math. 13 (1974) 117). That is colouring a graph: greedily, each column takes the first
/// colour that is free, once from the left and once by falling number of places, and the better of
/// the two is kept (T. F. Coleman, J. J. More, "Estimation of sparse Jacobian matrices and graph
/// coloring problems", SIAM J. Numer. Anal. 20 (1983) 187). The fullest row is a lower bound; where
/// that is over half of the columns each gets a colour of its own.
Colouring colour(const JacobianPattern& pattern);

}  // namespace saltus
