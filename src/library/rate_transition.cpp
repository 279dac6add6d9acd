// y[k] = u[k]: the input at tick k, at t = offset + k dt, held to the next tick.
#include "saltus/library/rate_transition.hpp"

namespace saltus {

RateTransition::RateTransition(std::string name, double dt, const Options& options)
    : SampledSystem(std::move(name)) {
  declare_input_port({.name = "in", .shape = options.initial_state.shape()});
  declare_law({.dt = dt,
               .before = options.initial_state,
               .feedthrough = {0},
               .output = [](const At& at, const VectorView&, VectorRef y) { y = at.u[0]; },
               .offset = options.offset});
}

}  // namespace saltus
