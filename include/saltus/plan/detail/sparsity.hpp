// The entries of d(xdot)/d(x) that may differ from zero, from declarations and wires.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus {

/// Entries of an n by n matrix, column by column.
struct Sparsity {
  List<Index> start = {0};  // the begin of each column in `rows`; then the end
  List<int> rows;           // increase in each column

  Index columns() const { return static_cast<Index>(start.size()) - 1; }
  Index size() const { return static_cast<Index>(rows.size()); }
  std::span<const int> column(Index j) const {
    return {rows.data() + start[j], rows.data() + start[j + 1]};
  }
};

/// Every entry of an n by n matrix.
Sparsity full_sparsity(Index n);

/// The entries of d(xdot)/d(x), and the source of their values.
struct JacobianPattern {
  Sparsity places;       ///< a superset of the entries that differ from zero; the diagonal is in it
  std::vector<int> own;  ///< leaves whose own Jacobian gives their diagonal block
  List<char> differences;  ///< for each entry: 1 if only differences give its value
  bool overflow = false;   ///< there are more than most_places(n) entries; `places` is empty
};

/// A matrix with more entries is not worth building: 4 million, or 256 a state.
constexpr Index most_places(Index n) { return std::max(Index{4'000'000}, 256 * n); }

/// The entries found for blocks that declare none, by number of the leaf. They count as declared.
using FoundBlocks = std::map<int, std::vector<MatrixEntry>>;

/// Follows every wire from the states through the values that the derivatives read: by entries if a
/// declaration gives them (EntryRule, declare_jacobian_sparsity), otherwise by whole signals.
/// Relations and opaque booleans are held between instants, so nothing passes through them. A stiff
/// method calls this when it starts. The time is linear in blocks, wires and entries. Throws
/// ModelError for a declared entry outside the block's n by n matrix, or an entry named twice.
JacobianPattern jacobian_pattern(const Plan& plan, const FoundBlocks& found = {});

}  // namespace saltus
