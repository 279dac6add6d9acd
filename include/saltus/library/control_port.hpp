// y = true while u > 0: the control signal of an EnabledSubsystem or a TriggeredSubsystem.
// in: a scalar, real or boolean. The crossings of zero are located, and y is held in between; at
// u = 0 exactly y is false.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class ControlPort final : public LeafSystem {
 public:
  explicit ControlPort(std::string name);
};

}  // namespace saltus
