// y = interval round(u / interval), elementwise: the nearest level, with a level at 0.
// in: any width. out: the width of u and the interval. Parameter "interval". If y reaches a
// derivative, the times at which the level changes are located, and the level is held between
// instants. Halfway between two levels y is either of them.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

class Quantizer final : public LeafSystem {
 public:
  Quantizer(std::string name, const Value& interval);
};

}  // namespace saltus
