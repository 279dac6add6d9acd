// y = u^exponent, elementwise.
// in: any width. out: the width of u and the exponent. Parameter "exponent". A negative u needs a
// whole exponent: otherwise y is not a number, and the run ends with an error that says where.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

class Power final : public LeafSystem {
 public:
  Power(std::string name, const Value& exponent);
};

}  // namespace saltus
