// A guard that is Inf fires nothing; a Jacobian that is not finite goes into no step.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

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

/// x' = -x with a Jacobian that is `bad` as long as t < until.
Results jacobian_that_is(double bad, double until, Method method) {
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 2.0}), .ode = [](const At& at, VectorRef xdot) { xdot = -at.x; }});
    l.declare_jacobian(
        [=](const At& at, MatrixRef j) { j << -1.0, at.time < until ? bad : 0.0, 0.0, -1.0; });
  });
  return simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
}

TEST_CASE("where a Jacobian is not finite, differences stand in, and that is told", "[errors]") {
  const auto method = GENERATE(Method::bdf, Method::radau);
  const Results well = jacobian_that_is(0.0, 0.0, method);
  CHECK(!contains(well.statistics.linear_solver, "not finite"));
  const double bad = GENERATE(from_range(std::vector{not_a_number, infinite}));
  const Results results = jacobian_that_is(bad, 1.0, method);
  INFO(results.statistics.linear_solver);
  CHECK(contains(results.statistics.linear_solver,
                 "entry (0, 1) of the Jacobian of block 'leaf' was not finite at t = "));
  // That difference is zero exactly, as the entry should be: the same run to the last bit.
  CHECK(results.context.continuous_state() == well.context.continuous_state());
}

TEST_CASE("a root has no slope at zero, and goes on by differences", "[errors]") {
  // A tank that is empty: x' = 1 - sqrt(x), d(x')/dx = -1 / (2 sqrt(x)).
  const Leaf tank("tank", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return 1.0 - std::sqrt(at.x[0]); }});
    l.declare_jacobian([](const At& at, MatrixRef j) { j(0, 0) = -0.5 / std::sqrt(at.x[0]); });
  });
  const auto method = GENERATE(Method::bdf, Method::radau);
  const Results results = simulate(tank, tank.create_context(), {0.0, 30.0},
                                   {.rtol = 1e-8, .ode_solver_method = method});
  // In w = sqrt(x): w' = (1 - w) / (2 w), so t = -2 (w + log(1 - w)). Errors die out on the way.
  const double w = std::sqrt(results.context.continuous_state()[0]);
  CHECK_THAT(-2.0 * (w + std::log1p(-w)), WithinAbs(30.0, 1.0));
  CHECK_THAT(w, WithinAbs(1.0, 1e-6));
}
