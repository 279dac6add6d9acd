// The blocks of a plan as islands see them: which have states or events, count, or are copied.
#pragma once

#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/plan/plan.hpp"

namespace saltus::detail {

struct IslandBlocks {
  explicit IslandBlocks(const Plan& plan);

  List<char> read;    ///< of each node: whether it is read or recorded
  List<char> live;    ///< of each leaf: it has a state or an event; a located boolean has events
  List<char> active;  ///< of each leaf: it is live, or is read or recorded, or feeds such a leaf
  /// Of each leaf: each island that reads it has a copy. It is not live, or it is a source that has
  /// time events only; and all blocks that it reads are copied.
  List<char> copied;
};

/// The other leaves that a leaf reads, in order.
std::vector<int> sources_of(const Plan& plan, int leaf);

/// The leaf that has this entry of the parameters of all.
int leaf_of_parameter(const Plan& plan, Index entry);
/// Of each leaf: the numbers of the parameters that diagrams compute for it.
List<std::vector<int>> computed_by_leaf(const Plan& plan);

}  // namespace saltus::detail
