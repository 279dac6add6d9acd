// Ends the run, with the status `terminal`, when its input becomes true; at once if it is true.
// in: one boolean. The row after the instant is kept.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Stop final : public LeafSystem {
 public:
  explicit Stop(std::string name);
};

}  // namespace saltus
