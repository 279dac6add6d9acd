// y = k dt [s], from tick k to the next tick.
#include "saltus/library/discrete_clock.hpp"

#include "saltus/library/detail/schedule.hpp"

namespace saltus {

DiscreteClock::DiscreteClock(std::string name, double dt) : SampledSystem(std::move(name)) {
  declare_law({.dt = dt, .output = [=](const At& at, const VectorView&, VectorRef y) {
                 y[0] = dt * detail::last_tick(at.time, dt);
               }});
}

}  // namespace saltus
