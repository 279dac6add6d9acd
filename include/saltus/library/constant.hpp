// y = value.
// out: shape of `value`. Parameter "value". The output is a view of the context: nothing is ever
// computed.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

class Constant final : public LeafSystem {
 public:
  Constant(std::string name, const Value& value);
};

}  // namespace saltus
