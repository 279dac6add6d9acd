// Derivatives where a tick meets a guard, or a truth that is about to change.
#include <cmath>
#include <string>
#include <vector>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace sensitivities_at_ticks {

namespace {

/// x' = 1 from 0, a guard x - p that sets x to 0, and a tick at 1 s that changes nothing.
Results ticks_beside(double p) {
  const Leaf leaf("leaf", [&](Leaf& l) {
    const ParameterIndex rate = l.declare_dynamic_parameter("rate", 1.0);
    const ParameterIndex level = l.declare_dynamic_parameter("p", p);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .formula = Formula([=](const auto& at) { return at.p(rate, 0); })});
    l.declare_zero_crossing(
        {.name = "hit",
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::negative_then_non_negative,
         .formula = Formula([=](const auto& at) { return at.x(0) - at.p(level, 0); })});
    l.declare_time_event(
        {.name = "tick", .update = [](const At&, Next&) {}, .times = std::vector{1.0}});
  });
  return simulate(leaf, leaf.create_context(), {0.0, 1.5}, {.sensitivity = {"p"}});
}

}  // namespace

// The rounding of the guard is 1e3 eps (|x| + |t x'|) = 4.4e-13, that of x some 1e-15.
TEST_CASE(
    "a guard that is within its rounding of zero at a tick has a gap, and one beyond has none",
    "[sensitivity]") {
  const Results within = ticks_beside(1.0 + 1e-13), beyond = ticks_beside(1.0 + 1e-11);
  REQUIRE(within.sensitivities.gaps.size() == 1);
  CHECK(within.sensitivities.gaps[0].event == "leaf.hit");
  CHECK(within.sensitivities.gaps[0].reason ==
        "another event happens at the same time, and their order would change");
  CHECK(std::isnan(within.sensitivities.continuous_state[0]));
  CHECK(beyond.sensitivities.gaps.empty());
  CHECK(std::abs(beyond.sensitivities.continuous_state[0] + 1.0) < 1e-9);  // x = t - p
}

}  // namespace sensitivities_at_ticks
