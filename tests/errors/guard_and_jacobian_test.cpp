// A guard that is Inf fires nothing, and a Jacobian that is not finite goes into no step.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// What a run says whose guard is 5 up to x = t = 1, then `bad`.
std::string guard_that_becomes(double bad) {
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [=](const At& at) { return at.x[0] > 1.0 ? bad : 5.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  return message<SimulationError>([&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}); });
}

}  // namespace

TEST_CASE("a guard that becomes -Inf is an error, not an event", "[errors]") {
  const std::string what = guard_that_becomes(-infinite);
  INFO(what);
  CHECK(contains(what, "guard 'leaf.level' is not finite"));
}

TEST_CASE("a guard that becomes +Inf is an error, too", "[errors]") {
  CHECK(contains(guard_that_becomes(infinite), "guard 'leaf.level' is not finite"));
}

TEST_CASE("a Jacobian that is not finite is named with its block", "[errors]") {
  const double bad = GENERATE(from_range(std::vector{not_a_number, infinite}));
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
