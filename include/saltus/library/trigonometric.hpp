// y = function(u), elementwise, angles in rad.
// functions: sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh. in: any width. out: the
// same width. Outside the domain of an inverse function the run ends with an error.
#pragma once

#include <string_view>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Trigonometric final : public LeafSystem {
 public:
  Trigonometric(std::string name, std::string_view function);
};

}  // namespace saltus
