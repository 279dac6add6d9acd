// y[k] = u[k-1], y[0] = initial_state; held from tick k, at t = k dt, to the next tick.
// in, out: the shape of initial_state. Ticks are exact time events.
// At a tick all outputs change first, then all delays sample: y is computed from the time, before z
// is updated. If y were a view of z, a delay that reads a delay would sample the tick before, and n
// delays in a row would delay by 2n - 1 ticks.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct UnitDelayOptions {
  Value initial_state = 0.0;
};

class UnitDelay final : public LeafSystem {
 public:
  using Options = UnitDelayOptions;

  UnitDelay(std::string name, double dt, const Options& options = {});

 private:
  // z = (number of the last tick sampled; y since that tick; u sampled at it)
  void delayed(const At& at, VectorRef out) const;
  void sample(const At& at, Next& next) const;

  double dt_;  // [s]
  Index n_;    // width
};

}  // namespace saltus
