// MatrixEntry: an entry of a Jacobian that may differ from zero.
#pragma once

#include <algorithm>
#include <vector>

#include "saltus/base/ids.hpp"

namespace saltus {

/// One position in a matrix. Entry (row, column) of a Jacobian is d(xdot[row]) / d(x[column]).
struct MatrixEntry {
  Index row = 0, column = 0;
  bool operator==(const MatrixEntry&) const = default;
};

/// All entries of an n by n matrix up to `lower` positions below and `upper` above the diagonal,
/// column by column: `band_entries(n, 1, 1)` is a tridiagonal matrix.
inline std::vector<MatrixEntry> band_entries(Index n, Index lower, Index upper) {
  std::vector<MatrixEntry> entries;
  for (Index j = 0; j < n; ++j) {
    const Index first = std::max(Index{0}, j - upper), last = std::min(n - 1, j + lower);
    for (Index i = first; i <= last; ++i) entries.push_back({i, j});
  }
  return entries;
}

}  // namespace saltus
