// Ends the run, with the status `terminal`, when its input becomes true; at once if it is true.
#include "saltus/library/stop.hpp"

namespace saltus {

Stop::Stop(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_zero_crossing({.name = "stop",
                         .guard = [](const At& at) { return at.u(0) != 0.0 ? 1.0 : -1.0; },
                         .direction = Direction::negative_then_non_negative,
                         .terminal = true,
                         .at_start = AtStart::fire});
}

}  // namespace saltus
