// y = t [s].
// out: scalar. Continuous.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Clock final : public LeafSystem {
 public:
  explicit Clock(std::string name) : LeafSystem(std::move(name)) {
    declare_output_port(
        {.name = "out", .reads = Reads::time, .formula = [](const auto& at) { return at.time(); }});
  }
};

}  // namespace saltus
