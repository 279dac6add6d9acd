// A monitor is located and logged and changes no bit of the trajectory.
#include "support/balls.hpp"
#include "support/bouncing.hpp"
#include "support/cases.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

const double pi = std::acos(-1.0);

/// A pendulum, with `monitors` guards that only look.
Leaf pendulum(int monitors) {
  return Leaf("pendulum", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -std::sin(at.x[0]); }});
    l.declare_continuous_state_output("state");
    for (int i = 0; i < monitors; ++i) {
      l.declare_zero_crossing(
          {.name = text("level_", i), .guard = [=](const At& at) { return at.x[0] - 0.1 * i; }});
    }
  });
}

}  // namespace

TEST_CASE("a trajectory is bit-identical with monitors and without", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf with = pendulum(10), without = pendulum(0);
  const auto run = [&](const Leaf& leaf) {
    return simulate(leaf, leaf.create_context(), {0.0, 30.0},
                    {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  };
  const auto a = run(with), b = run(without);
  CHECK(a.events.size() > 80);
  CHECK(a.time == b.time);
  CHECK(column(a, "x") == column(b, "x"));
  CHECK(a.context.continuous_state() == b.context.continuous_state());
  CHECK(a.statistics.steps == b.statistics.steps);
  CHECK(a.statistics.restarts == 0);
}

TEST_CASE("a monitor beside a bouncing ball changes no bit of it", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto ball = [](bool watched) {
    return Leaf("ball", [=](Leaf& l) {
      if (watched)
        l.declare_zero_crossing({.name = "top", .guard = [](const At& at) { return at.x[1]; }});
      declare_bouncing(l, 5.0, 9.81);
    });
  };
  const Leaf watched = ball(true), plain = ball(false);
  const auto a =
      simulate(watched, watched.create_context(), {0.0, 7.0}, {.ode_solver_method = method});
  const auto b = simulate(plain, plain.create_context(), {0.0, 7.0}, {.ode_solver_method = method});
  CHECK(a.events.times("bounce") == b.events.times("bounce"));
  CHECK(a.context.continuous_state() == b.context.continuous_state());
  CHECK(a.events.times("top").size() >= 5);
}

namespace {

/// A ball with drag over a swinging floor. It bounces, and a reset map counts its tops. `monitors`
/// guards look at states, at the time, and at the surfaces of the other guards.
Leaf room(int monitors) {
  return Leaf("room", [=](Leaf& l) {
    const auto floor = [](const At& at) { return at.x[0] - 0.05 * std::sin(3.0 * at.time); };
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.3}), .ode = [](const At& at, VectorRef xdot) {
           xdot << at.x[1], -9.81 - 0.3 * at.x[1] * std::abs(at.x[1]);
         }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_continuous_state_output("x");
    int left = monitors;
    const auto watch = [&](const char* name, auto guard, Direction to = Direction::crosses_zero) {
      if (left-- > 0) l.declare_zero_crossing({.name = name, .guard = guard, .direction = to});
    };
    l.declare_zero_crossing({.name = "bounce",
                             .guard = floor,
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   const double v = 0.15 * std::cos(3.0 * at.time);
                                   next.set_continuous_state(
                                       {at.x[0], v + 0.9 * std::abs(at.x[1] - v)});
                                 },
                             .direction = Direction::positive_then_non_positive});
    l.declare_zero_crossing({.name = "top",
                             .guard = [](const At& at) { return at.x[1]; },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive});
    watch("same", floor);
    // After each bounce it is beyond zero.
    watch(
        "near", [](const At& at) { return at.x[0] - 0.06; }, Direction::positive_then_non_positive);
    watch("turn", [](const At& at) { return at.x[1]; });
    watch("clock", [](const At& at) { return std::sin(25.0 * at.time); });
    watch("truth", [](const At& at) { return at.x[0] > 0.2 ? 1.0 : -1.0; });
  });
}

}  // namespace

TEST_CASE("one to five monitors change no bit of rows and of other events", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  const int monitors = GENERATE(1, 2, 3, 4, 5);
  INFO("method " << method << ", monitors " << monitors);
  const auto run = [&](const Leaf& leaf) {
    return simulate(leaf, leaf.create_context(), {0.0, 4.0},
                    {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  };
  const Leaf plain = room(0), watched = room(monitors);
  const Results a = run(plain), b = run(watched);
  CHECK(a.events.size() > 10);
  CHECK(b.events.size() > a.events.size());
  CHECK(a.time == b.time);
  CHECK(column(a, "x") == column(b, "x"));
  CHECK(a.events.times("bounce") == b.events.times("bounce"));
  CHECK(a.events.times("top") == b.events.times("top"));
  CHECK(a.context.continuous_state() == b.context.continuous_state());
  CHECK(a.context.discrete_state() == b.context.discrete_state());
  // A monitor of the same surface fires when the guard fires. The times may differ by the rounding
  // of the height, up to 1 m, at a speed of 1 m/s or more.
  CHECK(worst(b.events.times("same"), a.events.times("bounce")) <= 4.0 * eps);
}

TEST_CASE("a monitor that is beyond zero changes no look at other guards", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  std::vector<double> looks;  // at the level, as states: those of the solver, after the start
  const auto run = [&](bool watched) {
    const Leaf leaf("leaf", [&](Leaf& l) {
      declare_ramp(l);
      l.declare_zero_crossing(
          {.name = "level",
           .guard =
               [&](const At& at) {
                 if (at.x[0] > 0.0) looks.push_back(at.x[0]);
                 return at.x[0] - 0.7;
               },
           .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
      if (watched)
        l.declare_zero_crossing({.name = "beyond",
                                 .guard = [](const At& at) { return at.x[0] - 2.0; },
                                 .direction = Direction::positive_then_non_positive});
    });
    looks.clear();
    const Results results =
        simulate(leaf, leaf.create_context(), {0.0, 5.0}, {.ode_solver_method = method});
    CHECK(results.events.size() == 7);
    return looks;
  };
  const std::vector<double> plain = run(false);
  CHECK(run(true) == plain);
}

TEST_CASE("what a monitor logs is the time, the direction and the state", "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("clock", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_zero_crossing({.name = "zero", .guard = [](const At& at) { return at.x[0] - 0.5; }});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 6.0},
                                {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method});
  REQUIRE(results.events.size() == 2);
  // Error of x below 100 tolerances over one turn; slope 0.87 at the crossing. The multistep
  // interpolants are a power of ten behind.
  CHECK_THAT(results.events[0].time, WithinAbs(pi / 6.0, 1e-7));
  CHECK_THAT(results.events[1].time, WithinAbs(5.0 * pi / 6.0, 1e-7));
  CHECK(results.events[0].direction == 1);
  CHECK(results.events[1].direction == -1);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK_THAT(results.events[i].before[0], WithinAbs(0.5, 1e-9));
    CHECK(std::ranges::equal(results.events[i].before, results.events[i].after));
    CHECK(results.events[i].jump == 0);
  }
}

TEST_CASE("events of monitors and of others stand in the log in the order of time",
          "[laws][monitors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (int i = 0; i < 20; ++i) {
      const bool look = i % 3 != 0;
      l.declare_zero_crossing({.name = text("at_", i),
                               .guard = [=](const At& at) { return at.x[0] - 0.04 * (i + 1); },
                               .reset_map = look ? ResetMap() : ResetMap(count_up)});
    }
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(results.events[i].name == text("at_", i));
    CHECK_THAT(results.events[i].time, WithinAbs(0.04 * static_cast<double>(i + 1), 1e-9));
  }
}
