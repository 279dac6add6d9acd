// Departure: the side to which the flow takes a guard that is at zero, and how well it is known.
#include "saltus/simulation/detail/departure.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A chain of integrators x0' = x1, x1' = x2, ..., with the last derivative constant, and a guard.
struct Chain {
  template <class Guard>
  Chain(std::initializer_list<double> x, double last, Guard guard, SimulatorOptions options = {})
      : leaf("leaf",
             [&](Leaf& l) {
               l.declare_continuous_state(
                   {.initial = vec(x), .ode = [last](const At& at, VectorRef xdot) {
                      xdot.head(xdot.size() - 1) = at.x.tail(xdot.size() - 1);
                      xdot[xdot.size() - 1] = last;
                    }});
               l.declare_zero_crossing({.name = "g", .guard = guard});
             }),
        departure(machine, options) {
    machine.load(leaf.create_context());
  }
  Departure::Side side(double error = 0.0, double longest = 10.0, double t = 0.0,
                       int expected = 0) {
    departure.from(t, machine.x, longest);
    return departure.of(group(), 0, error, expected);
  }
  double slope(double t = 0.0) {
    departure.from(t, machine.x, 10.0);
    return departure.slope(group(), 0);
  }
  const GuardGroup& group() const { return machine.plan().guards[0]; }

  Leaf leaf;
  Machine machine{compile(leaf)};
  Departure departure;
};

const auto height = [](const At& at) { return at.x[0]; };

}  // namespace

TEST_CASE("the side is that of the first derivative along the flow that is not zero",
          "[departure]") {
  const double sign = GENERATE(1.0, -1.0);
  const int side = static_cast<int>(sign);
  CHECK(Chain({0.0}, sign, height).side().side == side);
  CHECK(Chain({0.0, sign}, -9.81 * sign, height).side().side == side);      // thrown off
  CHECK(Chain({0.0, 0.0}, sign, height).side().side == side);               // at rest
  CHECK(Chain({0.0, 0.0, 0.0}, sign, height).side().side == side);          // third
  CHECK(Chain({0.0, 0.0, 0.0, 0.0}, sign, height).side().side == side);     // fourth
  CHECK(Chain({0.0, 0.0, sign}, -1e3 * sign, height).side().side == side);  // second first
}

TEST_CASE("the side does not depend on the units of the guard, of the states or of the time",
          "[departure]") {
  const double unit = GENERATE(1e-200, 1e-6, 1.0, 1e6, 1e200);
  INFO("unit " << unit);
  CHECK(Chain({0.0, 0.0}, -9.81, [=](const At& at) { return unit * at.x[0]; }).side().side == -1);
  const double length = GENERATE(1e-6, 1.0, 1e6);
  const SimulatorOptions options{.atol = 1e-8 * length};
  CHECK(Chain({0.0, 0.0}, -9.81 * length, height, options).side().side == -1);
  CHECK(Chain({0.0, 0.0}, -9.81, height).side(0.0, length).side == -1);
}

TEST_CASE("a guard that stays within its rounding has no side", "[departure]") {
  CHECK(Chain({0.0, 0.0}, 0.0, height).side().side == 0);
  CHECK(Chain({0.1 + 0.2}, 0.0, [](const At& at) { return at.x[0] - 0.3; }).side().side == 0);
  CHECK(Chain({1.0, 1.0}, 1.0, [](const At& at) { return at.x[0] - at.x[0]; }).side().side == 0);
}

TEST_CASE("a guard moved by the time alone has the side to which the time takes it",
          "[departure]") {
  const double rate = GENERATE(1.0, -1.0, 1e-3);
  const double t = GENERATE(0.0, 1.0, 1e4);
  INFO("rate " << rate << ", t = " << t);
  Chain chain({1.0}, 0.0, [=](const At& at) { return rate * (at.time - t); });
  CHECK(chain.side(0.0, 10.0, t).side == sign_of(rate));
}

TEST_CASE("a guard within an error is followed until it has left the error", "[departure]") {
  // Thrown up from 1e-3 below: for 2e-3 s at 1 m/s it is within an error of 1e-3.
  Chain chain({-1e-3, 1.0}, 0.0, height);
  CHECK(chain.side(0.0).side == -1);
  const Departure::Side within = chain.side(1e-3);
  CHECK(within.side == 1);
  CHECK(chain.side(1e-3, 10.0, 0.0, -1).side == 1);
  CHECK(within.rounding >= 1e-3);
  CHECK(within.rounding <= 1.01e-3);
}

TEST_CASE("a guard that does not leave its error is followed to the end of the run, not further",
          "[departure]") {
  double furthest = 0.0;
  Chain chain({1.0}, 0.0, [&](const At& at) {
    furthest = std::max(furthest, at.time);
    return 1e-3 * at.x[0];
  });
  for (const double longest : {1.0, 1e3}) {
    furthest = 0.0;
    CHECK(chain.side(1.0, longest).side == 0);
    CHECK(furthest <= longest * (1.0 + 64.0 * eps));  // the rounding of a time is looked at too
    CHECK(furthest >= longest / 8.0);
  }
}

TEST_CASE("the rounding bounds the noise of the guard, and is no larger than a thousand of it",
          "[departure]") {
  const double size = GENERATE(1.0, 1e6, 1e9);
  INFO("size " << size);
  Chain chain({size, 0.0}, -9.81, [=](const At& at) { return at.x[0] - size; });
  chain.departure.from(0.0, chain.machine.x, 10.0);
  const double noise = eps * size, rounding = chain.departure.rounding(0);
  CHECK(rounding >= noise);
  CHECK(rounding <= 1e3 * noise);
}

TEST_CASE("the slope of a guard that moves is exact, and that of a guard at rest is zero",
          "[departure]") {
  const double speed = GENERATE(1.0, -2.0, 1e-3);
  // Two forward differences, extrapolated: the error is of the order of the rounding over d, and d
  // is the time of a move by the tolerance, 1e-8.
  CHECK_THAT(Chain({0.0, speed}, -9.81, height).slope(), WithinRel(speed, 1e-5));
  CHECK(Chain({0.0, 0.0}, -9.81, height).slope() == 0.0);
  CHECK(Chain({0.0, 0.0}, 9.81, height).slope(1e3) == 0.0);
}

TEST_CASE("the slope along another flow is that of the other flow", "[departure]") {
  Chain chain({0.0, 1.0}, 0.0, height);
  chain.departure.from(0.0, chain.machine.x, 10.0);
  CHECK_THAT(chain.departure.slope_along(vec({-3.0, 0.0}), chain.group(), 0),
             WithinRel(-3.0, 1e-5));
}

TEST_CASE("the tolerance of a guard is thirty of its states' tolerances", "[departure]") {
  const SimulatorOptions options{.rtol = 1e-6, .atol = 1e-9};
  Chain chain({2.0, 0.0}, 0.0, [](const At& at) { return at.x[0] - 2.0; }, options);
  chain.departure.from(0.0, chain.machine.x, 10.0);
  // The disturbance weighs a state by 0.5 to 1.
  const double states = 30.0 * (1e-6 * 2.0 + 1e-9), found = chain.departure.tolerance(0);
  CHECK(found >= 0.5 * states);
  CHECK(found <= states);
}

TEST_CASE("an expected side costs no more calls, and gives the same side", "[departure]") {
  // At rest the guard moves by the square of the time, less than the states do: its rounding would
  // have to be measured. Thrown, it moves as they do.
  Chain chain({0.0, -1.0}, -9.81, height);
  const auto calls = [&](int expected) {
    const auto before = chain.machine.guard_calls;
    CHECK(chain.side(0.0, 10.0, 0.0, expected).side == -1);
    return chain.machine.guard_calls - before;
  };
  const auto measured = calls(0);
  CHECK(calls(-1) < measured);
  CHECK(calls(Departure::either_side) < measured);
  CHECK(calls(1) == measured);  // the other side has to be proved
}

TEST_CASE("neither rounding nor curvature is much of the speed of a guard", "[departure]") {
  const SimulatorOptions options{.rtol = 1e-8, .atol = 1e-8};
  // A guard that is computed with a rounding of 1e-6, beside a movement that is not seen before.
  Chain rounded({0.3, 1.0}, 0.0, [](const At& at) { return (at.x[0] + 1e10) - 1e10; }, options);
  rounded.departure.from(0.0, rounded.machine.x, 10.0);
  CHECK_THAT(rounded.departure.speed(rounded.group(), 0, 10.0), WithinRel(1.0, 1e-3));
  // A flight that turns after 0.1 s.
  Chain bent({1.0, 1.0}, -9.81, height, options);
  bent.departure.from(0.0, bent.machine.x, 10.0);
  CHECK_THAT(bent.departure.speed(bent.group(), 0, 10.0), WithinRel(1.0, 0.1));
}

TEST_CASE("a guard that time moves has the side to which time takes it first", "[departure]") {
  // It rises, and falls below zero after 0.01 s; the state moves by its tolerance in 0.05 s, which
  // is long for a run of 10 s.
  const SimulatorOptions options{.rtol = 0.0, .atol = 1e-8};
  Chain chain({0.0}, 2e-7, [](const At& at) { return at.time * (0.01 - at.time); }, options);
  CHECK(chain.side().side == 1);
}

TEST_CASE("a guard that moves a hundredth as far as the states has a side without a doubt",
          "[departure]") {
  Chain chain({0.0, -1.0}, 0.0, [](const At& at) { return 0.01 * at.x[0]; });
  const auto before = chain.machine.guard_calls;
  CHECK(chain.side(0.0, 10.0, 0.0, Departure::either_side).side == -1);
  CHECK(chain.machine.guard_calls - before == 1);  // its rounding is not measured
}
