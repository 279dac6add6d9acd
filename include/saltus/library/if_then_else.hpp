// y = true_value if condition is true, otherwise false_value; elementwise.
// condition: one boolean, or one real number, true if not 0 (see Switch). true_value, false_value:
// scalars and vectors of one width.
// out: that width. It is a Switch whose ports have the order of the sentence "if, then, else".
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class IfThenElse final : public LeafSystem {
 public:
  explicit IfThenElse(std::string name);
};

}  // namespace saltus
