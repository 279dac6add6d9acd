// y = t [s].
// out: scalar. Continuous.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Clock final : public LeafSystem {
 public:
  explicit Clock(std::string name);
};

}  // namespace saltus
