// y = u[0] u[1] ...: the product of the entries.
// in: any width. out: scalar.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class ProductOfElements final : public LeafSystem {
 public:
  explicit ProductOfElements(std::string name);
};

}  // namespace saltus
