// y[k] = u[k-1], y[0] = initial_state; held from tick k, at t = k dt, to the next tick.
#include "saltus/library/unit_delay.hpp"

#include "saltus/library/detail/schedule.hpp"

namespace saltus {

UnitDelay::UnitDelay(std::string name, double dt, const Options& options)
    : LeafSystem(std::move(name)), dt_(dt), n_(options.initial_state.values.size()) {
  if (dt != inherited_period) detail::require_period(this->name(), "dt", dt);
  const Eigen::VectorXd& initial = options.initial_state.values;
  Eigen::VectorXd z(1 + 2 * n_);
  z << -1.0, initial, initial;
  declare_discrete_state(z);
  declare_input_port({.name = "in", .shape = options.initial_state.shape()});
  declare_output_port({.name = "out",
                       .calc = &UnitDelay::delayed,
                       .shape = options.initial_state.shape(),
                       .reads = dt == inherited_period ? Reads::discrete_state
                                                       : Reads::discrete_state | Reads::schedule});
  declare_periodic_update(&UnitDelay::sample, dt, 0.0, "tick");
}

void UnitDelay::delayed(const At& at, VectorRef out) const {
  // Between ticks nothing moves on: a tick at which the block was not executed was none.
  const bool moves_on = dt_ == inherited_period || detail::is_due(at.time, at.z[0], dt_);
  out = at.z.segment(moves_on ? 1 + n_ : 1, n_);
}

void UnitDelay::sample(const At& at, Next& next) const {
  Eigen::VectorXd z(at.z.size());
  const double tick = dt_ == inherited_period ? at.z[0] : detail::last_tick(at.time, dt_);
  z << tick, at.z.tail(n_), at.u[0];
  next.set_discrete_state(z);
}

}  // namespace saltus
