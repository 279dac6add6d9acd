// y = 1 */ u_0 */ u_1 ..., elementwise, with one operator for each input: "*/" is u_0 / u_1, "/" is
// 1 / u_0.
// in_0, in_1, ...: scalars and vectors of one width. out: that width. A division by zero ends the
// run with an error.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Product final : public LeafSystem {
 public:
  explicit Product(std::string name, std::string_view operators = "**");
};

}  // namespace saltus
