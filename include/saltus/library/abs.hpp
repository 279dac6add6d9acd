// y = |u|, elementwise.
// in: any width. out: the same width. If y reaches a derivative, u = 0 is located and the side is
// held between instants: the solver sees +u or -u, never the kink.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Abs final : public LeafSystem {
 public:
  explicit Abs(std::string name);
};

}  // namespace saltus
