// A clock with one guard, and the times at which it fires.
#pragma once

#include <vector>

#include "support/leaves.hpp"

namespace support {

/// A clock x = t with one counted guard.
template <class Guard>
Leaf watcher(Guard guard, saltus::Direction direction = saltus::Direction::crosses_zero) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "hit", .guard = guard, .reset_map = count_up, .direction = direction});
  });
}

inline std::vector<double> hits(const Leaf& leaf, double end, saltus::Method method,
                                double max_step = infinite) {
  const auto results = simulate(
      leaf, leaf.create_context(), {0.0, end},
      {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method, .max_minor_step_size = max_step});
  return results.events.times("hit");
}

}  // namespace support
