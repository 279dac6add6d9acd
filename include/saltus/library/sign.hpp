// y = -1 for u < 0, 0 for u = 0, 1 for u > 0, elementwise.
// in: any width. out: the same width. If y reaches a derivative, u = 0 is located and the sign is
// held between instants: the solver sees constants, never the jump.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Sign final : public LeafSystem {
 public:
  explicit Sign(std::string name);
};

}  // namespace saltus
