// A Zeno point does not depend on the unit of time: with the default tolerance a hold begins when the
// gaps are short beside the first ones, too.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace zeno_units_test {

constexpr double e = 0.8, small = 1e-8;

/// A ball whose first fall, from the height 1, takes `fall` seconds: g = 2 / fall^2.
Leaf ball(double fall) {
  return Leaf("ball", [fall](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [fall](const At& at, VectorRef xdot) { xdot << at.x[1], -2.0 / (fall * fall); }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// The height, in which the first flight from the floor takes 2 e and each other one e times the one
/// before it.
double height(double time) {
  double begin = 1.0, speed = 2.0 * e, flight = 2.0 * e;
  while (time > begin + flight) begin += flight, flight *= e, speed *= e;
  const double s = time - begin;
  return s * (speed - s);
}

}  // namespace zeno_units_test

using namespace zeno_units_test;

TEST_CASE("a ball in any unit of time flies as long as in seconds", "[laws]") {
  const double fall = GENERATE(1e-12, 1e-9, 1e-7, 1e-6, 1e-4, 1e-2, 1.0, 1e3);
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::radau);
  INFO("first fall " << fall << " s, method " << method);
  const Leaf leaf = ball(fall);
  const auto run = [&](double falls) {
    return simulate(leaf, leaf.create_context(), {0.0, falls * fall},
                    {.atol = small, .ode_solver_method = method});
  };
  // Some ten flights, each with an error of the tolerance 1e-6; flights are parabolas, which each
  // method follows to the rounding.
  for (const double falls : {3.3, 5.0, 7.1, 8.0}) {
    INFO("after " << falls << " falls");
    CHECK_THAT(run(falls).context.continuous_state()[0], WithinAbs(height(falls), 1e-5));
  }
  const auto results = run(12.0);
  REQUIRE(count(results.events, EventKind::zeno_enter) == 1);
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind != EventKind::zeno_enter) continue;
    // 1 + 2 (e + e^2 + ...) falls, to the tolerance of the flights. The last gap is less than a
    // thousandth of the first one, 1.6, and the flights that are left take e / (1 - e) = 4 of it. Slow
    // balls rest where a velocity is below atol = small: a gap is 2 atol / g = atol fall^2 then.
    const double slow = 4.0 * small * fall * fall, error = 1e-6 * 9.0 * fall + slow;
    CHECK_THAT(results.events[i].predicted, WithinAbs(9.0 * fall, error));
    CHECK(results.events[i].time > (9.0 - 4.0 * 1.6e-3) * fall - error);
  }
  CHECK(results.context.continuous_state()[0] == 0.0);
}

TEST_CASE("a Zeno tolerance that the user gives counts alone", "[laws]") {
  const Leaf leaf = ball(1e-7);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 5e-7}, {.zeno_tolerance = 2e-6});
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
}
