// Which state reaches which derivative: the places of d(xdot)/d(x), from declarations and wires.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

/// Places of an n by n matrix, column by column.
struct Sparsity {
  std::vector<Index> start = {0};  // of each column in `rows`, and the end of the last
  std::vector<int> rows;           // increase in each column

  Index columns() const { return static_cast<Index>(start.size()) - 1; }
  Index size() const { return static_cast<Index>(rows.size()); }
  std::span<const int> column(Index j) const {
    const auto first = static_cast<std::size_t>(start[static_cast<std::size_t>(j)]);
    return {rows.data() + first,
            static_cast<std::size_t>(start[static_cast<std::size_t>(j) + 1]) - first};
  }
};

/// Every place of an n by n matrix.
Sparsity full_sparsity(Index n);

/// The places of d(xdot)/d(x), and who knows the values there.
struct JacobianPattern {
  Sparsity places;       ///< a superset of the entries that differ from zero; the diagonal is in it
  std::vector<int> own;  ///< leaves whose own Jacobian gives the block on the diagonal
  std::vector<char> differences;  ///< of each place: 1 where only differences tell
  bool overflow = false;          ///< more than most_places(n): `places` is left empty
};

/// More places are not worth a matrix: 4 million, or 256 a state.
constexpr Index most_places(Index n) { return std::max(Index{4'000'000}, 256 * n); }

/// Places of blocks that declare none, by number of the leaf: they count as if they were declared.
using FoundBlocks = std::map<int, std::vector<MatrixEntry>>;

/// Follows every wire from the states through what the derivatives read; by entries where a
/// declaration says so (EntryRule, declare_jacobian_sparsity), else whole signals. Relations and
/// opaque booleans are held between instants, so nothing passes through them. Made for a stiff
/// method, when it starts; linear in blocks, wires and places. Throws ModelError for a declared
/// entry outside the block's n by n matrix, or one that is named twice.
JacobianPattern jacobian_pattern(const Plan& plan, const FoundBlocks& found = {});

}  // namespace saltus
