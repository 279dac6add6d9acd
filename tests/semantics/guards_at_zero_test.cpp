// Semantics 2.3: a guard exactly at zero at the start takes the side of its first derivative along
// the flow that is not zero.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double level = 0.3;

/// y = level + sign t^order / order!, by a chain of integrators; a falling guard y - level.
Leaf chain(Index order, double sign, const ResetMap& reset) {
  return Leaf("chain", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = level * Eigen::VectorXd::Unit(order, 0), .ode = [=](const At& at, VectorRef f) {
           f.head(order - 1) = at.x.tail(order - 1);
           f[order - 1] = sign;
         }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [](const At& at) { return at.x[0] - level; },
                             .reset_map = reset,
                             .direction = Direction::positive_then_non_positive});
  });
}

std::vector<double> hits(const Leaf& leaf, Method method, double end = 1.0) {
  return simulate(leaf, leaf.create_context(), {0.0, end}, {.ode_solver_method = method})
      .events.times("hit");
}

/// A state that goes round: x = (cos t, sin t).
void declare_orbit(Leaf& l) {
  l.declare_continuous_state({.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
                                xdot << -at.x[1], at.x[0];
                              }});
}

}  // namespace

TEST_CASE("2.3 a guard with a reset that the flow takes to its firing side fires at t0",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Index order = GENERATE(1, 2);
  INFO("method " << method << ", first derivative that is not zero: " << order);
  CHECK(hits(chain(order, -1.0, count_up), method) == std::vector{0.0});
}

TEST_CASE("2.3 a guard that the flow takes to its armed side does not fire", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Index order = GENERATE(1, 2, 3);
  INFO("method " << method << ", first derivative that is not zero: " << order);
  CHECK(hits(chain(order, 1.0, count_up), method).empty());
}

TEST_CASE("2.3 the third derivative decides where the first two are zero", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  CHECK(hits(chain(3, -1.0, count_up), method) == std::vector{0.0});
}

TEST_CASE("2.3 a guard of time alone at zero at the start takes the side of its derivative",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double sign = GENERATE(1.0, -1.0);
  const double t0 = GENERATE(0.0, 5.0, -1e3);
  INFO("method " << method << ", sign " << sign << ", t0 " << t0);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [=](const At& at) { return sign * (at.time - t0); },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(leaf, leaf.create_context(t0), {t0, t0 + 1.0}, {.ode_solver_method = method});
  CHECK(results.events.times("hit") == (sign < 0.0 ? std::vector{t0} : std::vector<double>{}));
}

TEST_CASE("2.3 a monitor at zero at the start waits for its next zero", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto direction = GENERATE(Direction::crosses_zero, Direction::positive_then_non_positive,
                                  Direction::negative_then_non_negative);
  INFO("method " << method << ", direction " << to_string(direction));
  const Leaf orbit("orbit", [=](Leaf& l) {
    declare_orbit(l);
    l.declare_zero_crossing(
        {.name = "axis", .guard = [](const At& at) { return at.x[1]; }, .direction = direction});
  });
  const auto results = simulate(orbit, orbit.create_context(), {0.0, 7.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  // Falls through the axis at pi, rises at 2 pi. Error: 100 tolerances a turn, slope 1.
  const double pi = std::acos(-1.0);
  std::vector<double> expected;
  if (direction != Direction::negative_then_non_negative) expected.push_back(pi);
  if (direction != Direction::positive_then_non_positive) expected.push_back(2.0 * pi);
  const auto found = results.events.times("axis");
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK_THAT(found[i], WithinAbs(expected[i], 1e-6));
}

TEST_CASE("2.3 a terminal guard without a reset waits though the flow takes it to its firing side",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf orbit("orbit", [](Leaf& l) {
    declare_orbit(l);
    l.declare_zero_crossing({.name = "finish",
                             .guard = [](const At& at) { return -at.x[1]; },
                             .direction = Direction::positive_then_non_positive,
                             .terminal = true});
  });
  const auto results = simulate(orbit, orbit.create_context(), {0.0, 20.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(2.0 * std::acos(-1.0), 1e-6));
}
