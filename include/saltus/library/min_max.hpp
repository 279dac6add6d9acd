// y = the smallest, or the largest, of u_0, u_1, ..., elementwise.
// operation: "min" or "max". in_0, in_1, ...: scalars and vectors of one width. out: that width. If
// y reaches a derivative, the times at which another input takes over are located, and the choice
// is held between instants: the solver sees one input, never the kink.
#pragma once

#include <string_view>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MinMax final : public LeafSystem {
 public:
  MinMax(std::string name, std::string_view operation, int n_inputs = 2);

 private:
  /// The relation in which input k is beyond all inputs before it.
  RelationIndex beyond(int k, double sign);
};

}  // namespace saltus
