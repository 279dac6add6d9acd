// y = u_k, where k is the whole number nearest to control, at least 0 and at most the last input;
// elementwise.
// control: scalar. in_0, in_1, ...: scalars and vectors of one width. out: that width. If y reaches
// a derivative, the times at which control passes k - 1/2 are located, and the choice is held
// between instants.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class MultiportSwitch final : public LeafSystem {
 public:
  MultiportSwitch(std::string name, int n_inputs);
};

}  // namespace saltus
