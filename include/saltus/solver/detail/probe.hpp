// The places of blocks that declare none, found by calling them.
#pragma once

#include <string>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/plan/detail/sparsity.hpp"

namespace saltus {

/// Of each block of more than 256 states that declares neither sparsity nor Jacobian: which of its
/// derivatives change when which of its states move (find_places). They are moved from two points
/// drawn at random beside the state, 1e-4 and 1e-2 of max(|x_j|, root mean square of x) away, so
/// that an entry that vanishes at the state itself shows. States are never made NaN: a loop in a
/// user's function might not end, a table be read at no index.
///
/// What is found may be too little, where an entry vanishes all around the state: a spring that
/// does not touch yet. Whoever uses it has to look whether it explains how f moves, and to ask
/// again where it does not (Jacobian::explains).
class Probe {
 public:
  explicit Probe(Machine& machine);

  /// Adds what can be seen at (t, x). Whether that changed what is known. Nothing that a block
  /// throws ends the search: it is left as if full, and `words` has the message. An Interruption
  /// passes.
  bool look(double t, const double* x);
  /// All such blocks count as full from now on.
  void give_up(const std::string& why);

  const FoundBlocks& found() const noexcept { return found_; }
  /// Who was looked at and what came of it; empty if there was nobody.
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
