// y(t) = u(k dt) for k dt <= t < (k+1) dt.
#include "saltus/library/zero_order_hold.hpp"

namespace saltus {

ZeroOrderHold::ZeroOrderHold(std::string name, double dt, const Options& options)
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

}  // namespace saltus
