// y = (u, u, ..., u): a scalar as a vector of n equal entries.
// in: scalar. out: a vector of n.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class ScalarBroadcast final : public LeafSystem {
 public:
  ScalarBroadcast(std::string name, int n);
};

}  // namespace saltus
