// y = gain u, elementwise.
// in: any width. out: the width of u and gain, one of which may be a scalar. Parameter "gain".
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

class Gain final : public LeafSystem {
 public:
  Gain(std::string name, const Value& gain);
};

}  // namespace saltus
