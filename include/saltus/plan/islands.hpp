// Islands: the parts of a plan that read nothing of each other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

/// The islands of a plan: two blocks are in one island if a wire, or an event wire without a delay,
/// leads from one to the other, or if both have a queued zero crossing, because all of these share
/// one queue. Event wires with a delay lead from island to island. A source that only the
/// time moves, for example a Constant, a Sine or a Step, joins nothing: each island that reads it has
/// a copy of it, with the time events of the source. A block without state and event, whose outputs nobody reads or records, is in no
/// island.
struct Islands {
  /// A block that joins parts, which without it would be islands.
  struct Join {
    std::string reader;      ///< "supervisor.total", the name of an output, or of a block
    bool by_events = false;  ///< through event wires; `reader` is then "block.event_input"
    std::size_t parts = 0;  ///< the number of parts with a state or an event that it reads; its own
                            ///< part does not count
  };

  std::vector<std::vector<int>> leaves;       ///< of each island, in the order of their declaration
  List<int> first;                            ///< of each island: its first block, copies left out
  std::vector<std::vector<int>> taps;         ///< of each island: its recorded signals
  std::vector<std::vector<int>> event_wires;  ///< inside each island, if the plan has any
  std::vector<std::vector<int>> outgoing;     ///< to other islands, of each; empty if none has any
  /// Of each island: the parameters that diagrams compute for it, if there are any. The diagrams are
  /// among its leaves, as copies.
  std::vector<std::vector<int>> computed;
  /// The island of each leaf; of a copied source the first of its islands, if it has events or is
  /// recorded, otherwise -1; -1 also for a leaf in no island.
  List<int> of_leaf;
  List<std::size_t> diagrams;  ///< of each island: the diagrams whose parameters it has
  std::vector<Join> joins;     ///< the block that joins most parts first

  std::size_t count() const { return leaves.size(); }
  /// The number of blocks in an island. The parameters of a diagram are no block.
  std::size_t blocks(std::size_t k) const { return leaves[k].size() - nth(diagrams, k); }
  /// Whether event wires lead from island to island.
  bool are_wired() const { return !outgoing.empty(); }
  /// The number of islands, and the blocks that join.
  std::string describe() const;
};

/// What an event wire with a delay does to the islands of its two blocks. A run with sensitivities
/// joins them, because the derivative of a delivery is known where its event fires.
enum class DelayedWires { cut, join };

/// Finds the islands; the time is linear in blocks and wires. They are ordered by their first
/// block, copies left out.
Islands find_islands(const Plan& plan, DelayedWires delayed = DelayedWires::cut);

/// The plan of one island: its blocks alone, with their paths, declarations and order. Only the
/// recorded signals of its own blocks are in it.
std::shared_ptr<const Plan> plan_of_island(const Plan& plan, const Islands& islands, std::size_t k);

}  // namespace saltus
