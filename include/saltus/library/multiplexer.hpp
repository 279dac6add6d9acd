// y = (u_0; u_1; ...): the inputs in order.
// in_0, in_1, ...: any shapes, a matrix row by row. out: a vector of all entries.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Multiplexer final : public LeafSystem {
 public:
  Multiplexer(std::string name, int n_inputs);

 private:
  static Shape total(std::span<const Shape> inputs);
  static EntryRange entries(Index i, int k, std::span<const Index> widths);
};

}  // namespace saltus
