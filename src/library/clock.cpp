// y = t [s].
#include "saltus/library/clock.hpp"

namespace saltus {

Clock::Clock(std::string name) : LeafSystem(std::move(name)) {
  declare_output_port(
      {.name = "out", .reads = Reads::time, .formula = [](const auto& at) { return at.time(); }});
}

}  // namespace saltus
