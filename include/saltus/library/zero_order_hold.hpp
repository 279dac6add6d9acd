// y(t) = u(k dt) for k dt <= t < (k+1) dt.
// in, out: the shape of initial_state, the value before the first tick. Ticks are exact time
// events. y is a view of the discrete state, so it costs nothing. A block that samples y at the
// same tick gets the value before it.
#pragma once

#include "saltus/library/arguments.hpp"

namespace saltus {

struct ZeroOrderHoldOptions {
  Value initial_state = 0.0;  ///< its shape is the shape of the signal
};

class ZeroOrderHold final : public LeafSystem {
 public:
  using Options = ZeroOrderHoldOptions;

  ZeroOrderHold(std::string name, double dt, const Options& options = {})
      : LeafSystem(std::move(name)) {
    detail::require_period(this->name(), "dt", dt);
    const Shape shape = options.initial_state.shape();
    declare_discrete_state(options.initial_state.values);
    declare_input_port({.name = "in", .shape = shape});
    declare_output_port({.name = "out",
                         .shape = shape,
                         .reads = Reads::discrete_state,
                         .view = Place{Space::z, 0, shape.size}});
    declare_periodic_update([](const At& at, Next& next) { next.set_discrete_state(at.u[0]); }, dt,
                            0.0, "tick");
  }
};

}  // namespace saltus
