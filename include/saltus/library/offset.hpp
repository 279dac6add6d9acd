// y = u + offset, elementwise.
// in: any width. out: the width of u and offset, one of which may be a scalar. Parameter "offset".
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

class Offset final : public LeafSystem {
 public:
  Offset(std::string name, const Value& offset);
};

}  // namespace saltus
