// y = 1 / u, elementwise.
// in: any width. out: the same width. A division by zero ends the run with an error.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Reciprocal final : public LeafSystem {
 public:
  explicit Reciprocal(std::string name);
};

}  // namespace saltus
