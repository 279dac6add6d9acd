// y = sqrt(u), elementwise.
// in: any width, u >= 0. out: the same width. For u < 0 the run ends with an error: y is not a
// number there.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class SquareRoot final : public LeafSystem {
 public:
  explicit SquareRoot(std::string name);
};

}  // namespace saltus
