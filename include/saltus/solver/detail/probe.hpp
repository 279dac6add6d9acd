// Finds the places of blocks that declare none, by calls of their derivatives.
#pragma once

#include <string>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// Looks at each block of more than 256 states that declares neither sparsity nor Jacobian, and
/// finds which of its derivatives change when which of its states move (find_places). The states
/// are moved from two random points near the state, 1e-4 and 1e-2 of max(|x_j|, root mean square of
/// x) away, so that an entry that is zero only at the state itself is found. States are never set
/// to NaN: a loop in a user's function might not end, or a table might be read at no valid index.
///
/// The result misses an entry that is zero in a whole region around the state: a spring that does
/// not touch yet. The caller has to check whether the result explains how f moves, and to look
/// again if it does not (Jacobian::explains).
class Probe {
 public:
  explicit Probe(Machine& machine);

  /// Adds the places found at (t, x). Returns whether the known places changed. An exception of a
  /// block does not end the search: the block counts as full, and `words` has the message. An
  /// Interruption passes through.
  bool look(double t, const double* x);
  /// All such blocks count as full from now on.
  void give_up(const std::string& why);

  const FoundBlocks& found() const noexcept { return found_; }
  /// The blocks that were searched, and the results; empty if there were none.
  std::string words() const;

 private:
  struct Block {
    int leaf;
    int calls = 0;
    bool open = true;  // not given up
    std::string note = {};
  };
  bool look_at(Block& block, double t, const double* x);
  bool add(int leaf, const Sparsity& places);

  Machine* machine_;
  std::vector<Block> blocks_;
  FoundBlocks found_;
};

}  // namespace saltus
