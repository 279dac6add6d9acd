// y_k = part k of u, which is cut into n_outputs equal parts.
// in: a vector whose width is a multiple of n_outputs. out_0, out_1, ...: scalars if each part has
// one entry.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Demultiplexer final : public LeafSystem {
 public:
  Demultiplexer(std::string name, int n_outputs);
};

}  // namespace saltus
