// Semantics 2.3: a guard within rounding of zero has no side; its noise is no event.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two states that are equal but for rounding: x' = 0.3 sin t, once as 0.1 sin t three times. Ticks
/// that write continuous state restart the solver, and arm the guard anew, at every 0.01 s.
Leaf twins(bool with_reset) {
  return Leaf("twins", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0, 1.0}), .ode = [](const At& at, VectorRef f) {
                                  const double s = std::sin(at.time);
                                  f << 0.3 * s, 0.1 * s + 0.1 * s + 0.1 * s;
                                }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "noise",
                             .guard = [](const At& at) { return at.x[0] - at.x[1]; },
                             .reset_map = with_reset ? ResetMap(count_up) : ResetMap()});
    l.declare_periodic_update([](const At& at, Next& next) { next.set_continuous_state(at.x); },
                              0.01, 0.01);
  });
}

}  // namespace

TEST_CASE("2.3 a guard that stays within rounding of zero fires nothing, restarted 1000 times",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_reset = GENERATE(true, false);
  INFO("method " << method << ", reset " << with_reset);
  const Leaf leaf = twins(with_reset);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 10.0},
                                {.ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::reached_end);
  CHECK(results.events.times("noise").size() == 0);
}
