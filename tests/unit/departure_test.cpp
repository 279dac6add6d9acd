// Departure: the side to which the flow takes a guard that is at zero, and how well it is known.
#include "saltus/simulation/detail/departure.hpp"

#include <functional>
#include <numbers>

#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A chain of integrators x0' = x1, x1' = x2, ..., with the last derivative constant, and a guard.
struct Chain {
  using Call = std::function<double(const At&)>;

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

namespace {

/// Whether the slope of a guard g(x) at x = 0, with x' = 1, is sure. A look is 1e-8 ahead.
bool is_sure(const std::function<double(double)>& g) {
  Chain chain({0.0}, 1.0, [=](const At& at) { return g(at.x[0]); });
  chain.departure.from(0.0, chain.machine.x, 10.0);
  return chain.departure.is_slope_sure(chain.group(), 0);
}

}  // namespace

TEST_CASE("a slope is sure above the rounding of the values of the guard", "[departure]") {
  CHECK(is_sure([](double x) { return 0.1 * x; }));
  CHECK(is_sure([](double x) { return -1e-30 * x; }));
  CHECK(is_sure([](double x) { return x - 2e7 * x * x; }));  // a hop that ends after five looks
  CHECK(
      !is_sure([](double x) { return 1e7 * x * x * x; }));  // over half of the time it is a quarter
  // A level that is taken off a number of its size: two last places of it are no slope.
  CHECK(is_sure([](double x) { return (1.0 + x) - 1.0; }));
  CHECK(!is_sure([](double x) { return (1.0 + 4.0 * eps * x / 1e-8) - 1.0; }));
  CHECK(!is_sure([](double x) { return std::sin(x + std::numbers::pi / 2.0) - 1.0; }));
  // Hops of every height that end after two to eight quarters of the look.
  for (double size = 1e-20; size < 1e20; size *= 3.7)
    for (double end = 0.5; end < 2.0; end += 0.0137)
      CHECK(is_sure([=](double x) { return size * x * (1.0 - x / (end * 1e-8)); }));
  // A parabola of a few roundings, 0, 0, 1, 3, 6, by any factor, is as flat at x = 0 as it looks.
  for (double factor : {1.0, 1.1, -1.0 / 3.0})
    CHECK(!is_sure([=](double x) { return factor * ((1.0 + 6.4 * eps * x * x / 1e-16) - 1.0); }));
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
  chain.side();  // the first departure also asks whether the guard follows the time
  const auto before = chain.machine.guard_calls;
  CHECK(chain.side(0.0, 10.0, 0.0, Departure::either_side).side == -1);
  CHECK(chain.machine.guard_calls - before == 1);  // its rounding is not measured
}

TEST_CASE("a speed far below the curvature of a flight is a speed", "[departure]") {
  // The height bends by 2.5e-9 m/s within the first look, and is known to 1e-22 m there.
  const double speed = 1e-13;
  CHECK_THAT(Chain({0.0, speed}, -9.81, height).slope(), WithinRel(speed, 1e-6));
}

TEST_CASE("the curvature that extrapolation leaves is no speed", "[departure]") {
  // g = x (1 + 100 t) with x = a t^2 / 2: of the bend over a first look d, extrapolation leaves the
  // part 100 d, and d = 1e-9 s.
  const Chain::Call guard = [](const At& at) { return at.x[0] * (1.0 + 100.0 * at.time); };
  CHECK(Chain({0.0, 0.0}, -9.81, guard).slope() == 0.0);
}

TEST_CASE("the rounding of a guard has seven digits, curved or not", "[departure]") {
  // The first state is disturbed by 0.618 of the others' most: sixteen roundings of it.
  const double size = GENERATE(1.0, 3.0);
  const double expected = 16.0 * eps * 0.618 * size;
  const auto rounding = [&](const Chain::Call& guard) {
    Chain chain({size}, 1.0, guard);
    chain.departure.from(0.0, chain.machine.x, 10.0);
    return chain.departure.rounding(0);
  };
  CHECK_THAT(rounding([=](const At& at) { return at.x[0] - size; }), WithinRel(expected, 2e-8));
  CHECK_THAT(rounding([=](const At& at) { return at.x[0] * at.x[0] - size * size; }),
             WithinRel(2.0 * size * expected, 2e-7));
}

TEST_CASE("a guard within its rounding is followed for some hundred thousand first looks",
          "[departure]") {
  // x0 moves by its tolerance in 1e-8 s. The rounding of x1 - x2 hides x0 for `looks` times that.
  const auto seen_after = [](double looks) {
    const SimulatorOptions options{.rtol = 0.0, .atol = 1e-8};
    const double weight = 16.0 * eps / (looks * 1e-8);
    const Leaf leaf("leaf", [&](Leaf& l) {
      l.declare_continuous_state({.initial = vec({0.0, 1.0, 1.0}),
                                  .ode = [](const At&, VectorRef xdot) { xdot << 1.0, 0.0, 0.0; }});
      l.declare_zero_crossing({.name = "g", .guard = [=](const At& at) {
                                 return weight * at.x[0] + (at.x[1] - at.x[2]);
                               }});
    });
    Machine machine{compile(leaf)};
    machine.load(leaf.create_context());
    Departure departure(machine, options);
    departure.from(0.0, machine.x, 10.0);
    return departure.of(machine.plan().guards[0], 0, 0.0, 0).side != 0;
  };
  CHECK(seen_after(3e4));
  CHECK_FALSE(seen_after(4e6));  // the solver finds it
}

namespace {

/// A height of 1e12 m, known to 2e-3 m, falls from rest. A guard reads it or a drift at `speed`
/// from the same height.
struct Far {
  explicit Far(double speed, bool falls)
      : leaf("leaf", [=](Leaf& l) {
          l.declare_continuous_state(
              {.initial = vec({1e12, 0.0, 1e12}),
               .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81, speed; }});
          l.declare_zero_crossing(
              {.name = "g", .guard = [=](const At& at) { return at.x[falls ? 0 : 2] - 1e12; }});
        }) {
    machine.load(leaf.create_context());
  }
  int side(double longest) {
    departure.from(0.0, machine.x, longest);
    return departure.of(machine.plan().guards[0], 0, 0.0, 0).side;
  }

  Leaf leaf;
  Machine machine{compile(leaf)};
  Departure departure{machine, SimulatorOptions{.rtol = 1e-8, .atol = 1e-8}};
};

}  // namespace

TEST_CASE("a fall is followed until it exceeds the rounding of a large height, within the run",
          "[departure]") {
  // The fall exceeds the rounding of 2e-3 m after 0.02 s: in a run of 100 s this is soon.
  CHECK(Far(0.0, true).side(100.0) == -1);
  CHECK(Far(0.0, true).side(20.0) == -1);
}

TEST_CASE("a drift that shows long after a fall would have shown is left to the solver",
          "[departure]") {
  CHECK(Far(6e-4, false).side(1e4) == 0);   // 5 s: a hundred times as long as a fall
  CHECK(Far(3e-2, false).side(10.0) == 0);  // 0.08 s: a fall, but a hundredth of the run
}

TEST_CASE("a run of no length has the time scale of its fastest state", "[departure]") {
  // The state moves by its tolerance in 1e-12 s.
  const SimulatorOptions options{.rtol = 0.0, .atol = 1e-8};
  const double scale = 1e-12;
  // A guard that time moves is looked at first after that time, and followed for 1e9 times as long.
  Chain turns(
      {0.0}, 1e4, [=](const At& at) { return at.time * (10.0 * scale - at.time); }, options);
  CHECK(turns.side(0.0, 0.0).side == 1);
  Chain rises({0.0}, 1e4, [](const At& at) { return at.time; }, options);
  CHECK(rises.side(1e8 * scale, 0.0).side == 1);
  CHECK(rises.side(1e10 * scale, 0.0).side == 0);
}

TEST_CASE("a run of less than a second is looked beyond, by a second at most", "[departure]") {
  const SimulatorOptions options{.rtol = 0.0, .atol = 1e-8};
  Chain rises({0.0}, 1e-2, [](const At& at) { return at.time; }, options);  // 1e-6 s
  CHECK(rises.side(0.2, 0.05).side == 1);
  CHECK(rises.side(2.0, 0.05).side == 0);
}

TEST_CASE("no look is further ahead than the longest step", "[departure]") {
  const SimulatorOptions options{.rtol = 0.0, .atol = 1e-8, .max_minor_step_size = 0.1};
  Chain rises({0.0}, 1e-2, [](const At& at) { return at.time; }, options);
  CHECK(rises.side(0.01).side == 1);
  CHECK(rises.side(0.2).side == 0);
}

TEST_CASE("the tolerance of a guard is that of the states that it reads", "[departure]") {
  // The disturbance weighs a state by 0.5 to 1.
  const SimulatorOptions options{.rtol = 0.0, .atol = std::vector{1e-9, 1e-3}};
  const auto found = [&](Index i) {
    Chain chain({0.0, 0.0}, 0.0, [=](const At& at) { return at.x[i]; }, options);
    chain.departure.from(0.0, chain.machine.x, 10.0);
    return chain.departure.tolerance(0);
  };
  CHECK(found(0) >= 0.5 * 30.0 * 1e-9);
  CHECK(found(0) <= 30.0 * 1e-9);
  CHECK(found(1) >= 0.5 * 30.0 * 1e-3);
  CHECK(found(1) <= 30.0 * 1e-3);
}

namespace {

/// Whether a ball is at the jump of a guard, and leaves it as from rest. It came from above at
/// 1 m/s; the guard is 1 above a surface that rises, and -1 elsewhere.
bool stops(double above, double speed, double last, double surface_speed = 0.0) {
  Chain chain({above, speed}, last,
              [=](const At& at) { return at.x[0] > surface_speed * (at.time - 1.0) ? 1.0 : -1.0; });
  chain.departure.from(1.0, chain.machine.x, 10.0);
  return chain.departure.stops_at_jump(chain.group(), 0, 1, vec({-1.0, -9.81}));
}

}  // namespace

TEST_CASE("a guard that jumps is at its jump where its states are, and leave it as from rest",
          "[departure]") {
  CHECK(stops(0.0, 0.0, -9.81));
  CHECK_FALSE(stops(-1e-3, 0.0, -9.81));      // beyond its jump
  CHECK_FALSE(stops(-1e-11, 0.0, -9.81));     // beyond it by more than the resolution of the time
  CHECK_FALSE(stops(0.0, -1.0, -9.81));       // passed through
  CHECK_FALSE(stops(0.0, 0.0, -1e8));         // too fast to tell from a passage
  CHECK_FALSE(stops(0.0, 0.0, 0.0));          // the flow stays at the jump
  CHECK_FALSE(stops(0.0, 0.0, -9.81, 1e-6));  // time alone turns it: its surface moves
}

TEST_CASE("a boolean function is looked at where its states have moved by more than their rounding",
          "[departure]") {
  // The first look is after a move by the tolerance, 1e-8, which a state of 1e9 does not show.
  auto [diagram, options] = [] {
    DiagramBuilder builder;
    auto& one = builder.add<Constant>("one", 1.0);
    auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 1e9});
    auto& above = builder.add<FunctionBlock>("above", [](double u) { return u > 1e9; });
    auto& reader = builder.add<Integrator>("reader", Integrator::Options{});
    builder.connect(one.output(), x.input());
    builder.connect(x.output(), above.input());
    builder.connect(above.output(), reader.input());
    return std::pair(builder.build(), SimulatorOptions{.rtol = 0.0, .atol = 1e-8});
  }();
  Machine machine{compile(diagram)};
  machine.load(diagram.create_context());
  Departure departure(machine, options);
  departure.from(0.0, machine.x, 10.0);
  const GuardGroup& group = machine.plan().guards.front();
  REQUIRE(group.is_opaque());
  CHECK(departure.of(group, 0, 0.0, 0).side == 1);
}
