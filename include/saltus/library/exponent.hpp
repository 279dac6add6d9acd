// y = e^u, or 2^u, elementwise.
// base: "exp" or "2". in: any width. out: the same width.
#pragma once

#include <string_view>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Exponent final : public LeafSystem {
 public:
  explicit Exponent(std::string name, std::string_view base = "exp");
};

}  // namespace saltus
