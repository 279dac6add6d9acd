// y = u_0 . u_1 = u_0[0] u_1[0] + u_0[1] u_1[1] + ...
// in_0, in_1: one width. out: scalar.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class DotProduct final : public LeafSystem {
 public:
  explicit DotProduct(std::string name);
};

}  // namespace saltus
