// Logs the times at which u passes an offset: a monitor, which changes no bit of the trajectory.
#include "saltus/library/hit_crossing.hpp"

namespace saltus {

HitCrossing::HitCrossing(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("offset", options.offset);
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  declare_zero_crossing({.name = "hit",
                         .direction = options.direction,
                         .formula = [k](const auto& at) { return at.u(0) - at.p(k); }});
}

}  // namespace saltus
