// What is not finite and not named yet: expected failures.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a guard that becomes Inf is an error, not an event", "[errors][!shouldfail]") {
  const double bad = GENERATE(infinite, -infinite);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [=](const At& at) { return at.x[0] > 1.0 ? bad : 5.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  const std::string what =
      message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); });
  INFO(what);
  CHECK(contains(what, "'leaf.level'"));
  CHECK(contains(what, "not finite"));
}

TEST_CASE("a Jacobian that is not finite is named with its block", "[errors][!shouldfail]") {
  const double bad = GENERATE(not_a_number, infinite);
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return -at.x[0]; }});
    l.declare_jacobian([=](const At&, MatrixRef j) { j(0, 0) = bad; });
  });
  const std::string what = message<SimulationError>(
      [&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = "bdf"}); });
  INFO(what);
  CHECK(contains(what, "Jacobian of block 'leaf' is not finite"));
}
