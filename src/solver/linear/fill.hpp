// The cost of a sparse factorisation, before it is made.
#pragma once

#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

struct Fill {
  double entries = 0.0;     ///< of L and U
  double operations = 0.0;  ///< multiplications and additions
};

/// Counts the cost by the elimination tree of the matrix plus its transpose, in the order of
/// minimum degree, without exchanges of rows (J. W. H. Liu, "A compact row storage scheme for
/// Cholesky factors using elimination trees", ACM TOMS 12 (1986) 127; P. R. Amestoy, T. A. Davis,
/// I. S. Duff, "An approximate minimum degree ordering algorithm", SIAM J. Matrix Anal. Appl. 17
/// (1996) 886). The time is linear in the entries of L. At `most` entries the count stops, with
/// infinite operations.
Fill predicted_fill(const Sparsity& places, double most);

}  // namespace saltus
