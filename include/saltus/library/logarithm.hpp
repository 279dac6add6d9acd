// y = log(u), elementwise.
// base: "natural", "10" or "2". in: any width, u > 0. out: the same width. For u <= 0 the run ends
// with an error: y is not finite there.
#pragma once

#include <string_view>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Logarithm final : public LeafSystem {
 public:
  explicit Logarithm(std::string name, std::string_view base = "natural");
};

}  // namespace saltus
