// y = +-u_0 +- u_1 ..., elementwise, with one sign for each input: "+-" is u_0 - u_1.
// in_0, in_1, ...: scalars and vectors of one width. out: that width.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Adder final : public LeafSystem {
 public:
  explicit Adder(std::string name, std::string_view operators = "++");
};

}  // namespace saltus
