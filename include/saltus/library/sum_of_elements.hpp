// y = u[0] + u[1] + ...: the sum of the entries.
// in: any width. out: scalar.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class SumOfElements final : public LeafSystem {
 public:
  explicit SumOfElements(std::string name);
};

}  // namespace saltus
