// y[k] = u[k-1], y[0] = initial_state; held from tick k, at t = k dt, to the next tick.
// in, out: the shape of initial_state. Ticks are exact time events.
// At a tick all outputs change first, then all delays sample: y is computed from the time, before z
// is updated. If y were a view of z, a delay that reads a delay would sample the tick before, and n
// delays in a row would delay by 2n - 1 ticks.
#pragma once

#include "saltus/library/arguments.hpp"
#include "saltus/library/schedule.hpp"

namespace saltus {

struct UnitDelayOptions {
  Value initial_state = 0.0;
};

class UnitDelay final : public LeafSystem {
 public:
  using Options = UnitDelayOptions;

  UnitDelay(std::string name, double dt, const Options& options = {})
      : LeafSystem(std::move(name)), dt_(dt), n_(options.initial_state.values.size()) {
    detail::require_period(this->name(), "dt", dt);
    const Eigen::VectorXd& initial = options.initial_state.values;
    Eigen::VectorXd z(1 + 2 * n_);
    z << -1.0, initial, initial;
    declare_discrete_state(z);
    declare_input_port({.name = "in", .shape = options.initial_state.shape()});
    declare_output_port({.name = "out",
                         .calc = &UnitDelay::delayed,
                         .shape = options.initial_state.shape(),
                         .reads = Reads::discrete_state | Reads::schedule});
    declare_periodic_update(&UnitDelay::sample, dt, 0.0, "tick");
  }

 private:
  // z = (number of the last tick sampled; y since that tick; u sampled at it)
  void delayed(const At& at, VectorRef out) const {
    const bool moved_on = detail::last_tick(at.time, dt_) != at.z[0];
    out = at.z.segment(moved_on ? 1 + n_ : 1, n_);
  }
  void sample(const At& at, Next& next) const {
    Eigen::VectorXd z(at.z.size());
    z << detail::last_tick(at.time, dt_), at.z.tail(n_), at.u[0];
    next.set_discrete_state(z);
  }

  double dt_;  // [s]
  Index n_;    // width
};

}  // namespace saltus
