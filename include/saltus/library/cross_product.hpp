// y = u_0 x u_1, of two vectors in space.
// in_0, in_1: vectors of 3. out: a vector of 3.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class CrossProduct final : public LeafSystem {
 public:
  explicit CrossProduct(std::string name);
};

}  // namespace saltus
