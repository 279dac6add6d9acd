// Colours: columns of a Jacobian with one colour are found by one difference.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// Columns by colour: the columns of colour c are columns[start[c]] to columns[start[c + 1] - 1].
struct Colouring {
  List<Index> start = {0};
  std::vector<int> columns;

  Index colours() const { return static_cast<Index>(start.size()) - 1; }
  std::span<const int> of(Index colour) const {
    return {columns.data() + start[colour], columns.data() + start[colour + 1]};
  }
};

/// Colours the columns that differences have to find. No row has entries in two columns of one
/// colour, so one call with all columns of a colour moved gives the entries of each (A. R. Curtis,
/// M. J. D. Powell, J. K. Reid, "On the estimation of sparse Jacobian matrices", IMA J. Appl. Math.
/// 13 (1974) 117). This is the colouring of a graph. A greedy pass gives each column the first free
/// colour. One pass takes the columns from the left, another by falling number of places, and the
/// better result is kept (T. F. Coleman, J. J. More, "Estimation of sparse Jacobian matrices and
/// graph coloring problems", SIAM J. Numer. Anal. 20 (1983) 187). The fullest row is a lower bound;
/// if it has over half of the columns, each column gets its own colour.
Colouring colour(const JacobianPattern& pattern);

}  // namespace saltus
