// Semantics 2.1: a guard may jump.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

const double root2 = std::sqrt(2.0);

/// x' = 1; x goes back to 0 where a guard of two values jumps, at sqrt(2).
Leaf saw(Direction direction, double before, double behind) {
  return Leaf("saw", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "jump",
         .guard = [=](const At& at) { return at.x[0] < root2 ? before : behind; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = direction});
  });
}

/// Seven teeth in ten seconds. The location of each is off by the resolution of the time.
void has_seven_teeth(const Leaf& leaf, Method method) {
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 10.0}, {.ode_solver_method = method});
  INFO(method);
  const std::vector<double> times = results.events.times("jump");
  REQUIRE(times.size() == 7);
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK(std::abs(times[i] - static_cast<double>(i + 1) * root2) < 100.0 * eps * 10.0 * 7.0);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
}

}  // namespace

TEST_CASE("2.1 a guard that jumps fires each time, whatever its two values", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  using Values = std::pair<double, double>;
  const auto [before, behind] = GENERATE(Values{1.0, -1.0}, Values{1e6, -1.0}, Values{1.0, 0.0},
                                         Values{1.0, -1e-300}, Values{1e-200, -1e200});
  has_seven_teeth(saw(Direction::positive_then_non_positive, before, behind), method);
  has_seven_teeth(saw(Direction::crosses_zero, before, behind), method);
  has_seven_teeth(saw(Direction::negative_then_non_negative, -before, -behind), method);
}

TEST_CASE("2.1 edge_detection fires at each change that time brings, and not at its own reset",
          "[semantics]") {
  has_seven_teeth(saw(Direction::edge_detection, 1.0, -1.0), GENERATE(from_range(methods)));
  has_seven_teeth(saw(Direction::edge_detection, 0.0, 1.0), GENERATE(from_range(methods)));
}

TEST_CASE("2.1 a staircase fires where it passes zero, again and again", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("saw", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "jump",
         .guard = [](const At& at) { return 2.5 - std::floor(3.0 * at.x[0] / root2); },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::positive_then_non_positive});
  });
  has_seven_teeth(leaf, method);
}

TEST_CASE("2.1 a monitor that jumps is logged each time", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("wave", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "jump", .guard = [](const At& at) {
                               return std::fmod(at.x[0], 2.0) < 1.0 ? 1.0 : -1.0;
                             }});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 9.5},
                                {.ode_solver_method = method, .max_minor_step_size = 0.25});
  CHECK(results.events.times("jump").size() == 9);
}

namespace {

struct Floor {
  double above, below;
  Direction direction;
};

/// A ball that is dropped from 5 m and keeps a part of its speed. Its guard says on which side of
/// the floor it is by two values.
Leaf bouncing_on(const Floor& floor, double kept) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({5.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [=](const At& at) { return at.x[0] > 0.0 ? floor.above : floor.below; },
         .reset_map =
             [=](const At& at, Next& next) {
               next.set_continuous_state({std::abs(at.x[0]), -kept * at.x[1]});
             },
         .direction = floor.direction});
  });
}

/// Only edge_detection sees a change between two values on one side of zero.
std::vector<Floor> floors() {
  using enum Direction;
  std::vector<Floor> all;
  for (const auto& [above, below] : {std::pair{1.0, -1.0}, {1.0, 0.0}}) {
    for (const auto direction : {positive_then_non_positive, crosses_zero, edge_detection})
      all.push_back({above, below, direction});
  }
  for (const auto& [above, below] : {std::pair{0.0, 1.0}, {3.0, 2.0}, {-2.0, -1e6}})
    all.push_back({above, below, edge_detection});
  return all;
}

}  // namespace

TEST_CASE("2.1 a ball whose guard is the truth `above the floor` bounces and stays above",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Floor floor = GENERATE(from_range(floors()));
  constexpr double e = 0.8;
  const Leaf ball = bouncing_on(floor, e);
  // Impacts at 1 s, and after flights of 2 e^k s; before 7 s there are five: 1, 2.6, 3.88, 4.904,
  // 5.7232, 6.37856 s are six.
  const auto results =
      simulate(ball, ball.create_context(), {0.0, 7.0}, {.ode_solver_method = method});
  const std::vector<double> times = results.events.times("bounce");
  REQUIRE(times.size() >= 6);
  double expected = 1.0;
  for (int k = 0; k < 6; ++k) {
    CHECK(std::abs(times[static_cast<std::size_t>(k)] - expected) < 1e-4);
    expected += 2.0 * std::pow(e, k + 1);
  }
  CHECK(results.context.continuous_state()[0] >= 0.0);
}

TEST_CASE("2.1 a ball whose guard is a truth rests from its Zeno point on, and goes on resting",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Floor floor = GENERATE(from_range(floors()));
  // Half of the speed leaves states that are exact in binary: the point of rest is a rounding above
  // the floor, or below it, or on it.
  const double e = GENERATE(0.5, 0.25, 0.75, 0.8);
  const Leaf ball = bouncing_on(floor, e);
  const auto results =
      simulate(ball, ball.create_context(), {0.0, 12.0}, {.ode_solver_method = method});
  INFO(method << ", " << floor.above << " above, " << floor.below << " below, keeps " << e);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(count(results.events, EventKind::zeno_release) == 0);
  CHECK(std::abs(results.context.continuous_state()[0]) < 1e-9);
}

namespace {

/// A block that falls onto a floor; its guard is the truth `above the floor`. The reset map keeps a
/// part of the speed.
Leaf falling_onto(double floor, double kept, double g = 10.0,
                  Direction direction = Direction::positive_then_non_positive) {
  return Leaf("block", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({floor + 5.0, -1.0}),
                                .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "impact",
         .guard = [=](const At& at) { return at.x[0] > floor ? 1.0 : -1.0; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({at.x[0], kept * at.x[1]}); },
         .direction = direction});
  });
}

}  // namespace

TEST_CASE("2.1 a block that a truth stops at once rests there, wherever its floor is",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double floor = GENERATE(0.0, 3.0, -1e5);
  const auto direction = GENERATE(Direction::positive_then_non_positive, Direction::crosses_zero,
                                  Direction::edge_detection);
  const Leaf block = falling_onto(floor, 0.0, 10.0, direction);
  const auto results =
      simulate(block, block.create_context(), {0.0, 7.0}, {.ode_solver_method = method});
  INFO(method << ", floor at " << floor);
  CHECK(results.events.times("impact").size() == 1);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  // It rests where the impact was located: the tolerance of the fall.
  CHECK(results.context.continuous_state()[0] == Approx(floor).margin(1e-4));
  CHECK(results.context.continuous_state()[1] == 0.0);
}

TEST_CASE("2.1 a block that a truth only slows, or that nothing pulls on, does not rest",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double kept = GENERATE(1.0, 0.5, 0.01);
  const auto direction = GENERATE(Direction::positive_then_non_positive, Direction::edge_detection);
  const Leaf block = falling_onto(2.0, kept, 10.0, direction);
  const auto results =
      simulate(block, block.create_context(), {0.0, 3.0}, {.ode_solver_method = method});
  INFO(method << ", kept " << kept);
  CHECK(results.events.times("impact").size() == 1);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  // From 7 m with 1 m/s down it reaches 2 m with sqrt(101) m/s.
  const double t = (std::sqrt(101.0) - 1.0) / 10.0, left = 3.0 - t;
  CHECK(results.context.continuous_state()[0] ==
        Approx(2.0 - kept * std::sqrt(101.0) * left - 5.0 * left * left).margin(1e-3));

  const Leaf lift = falling_onto(2.0, 0.0, 0.0);
  const auto stopped =
      simulate(lift, lift.create_context(), {0.0, 9.0}, {.ode_solver_method = method});
  CHECK(stopped.events.times("impact").size() == 1);
  CHECK(count(stopped.events, EventKind::zeno_enter) == 0);
  CHECK(stopped.context.continuous_state()[0] == Approx(2.0).margin(1e-4));
}

TEST_CASE("2.1 a block that goes on slowly through a truth does not rest", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double kept = GENERATE(1e-2, 1e-4, 1e-6);
  // A filling tank: its valve closes nearly at level 1, and a clock beside it goes on.
  const Leaf tank("tank", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], 0.0, 1.0; }});
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] < 1.0 ? 1.0 : -1.0; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({at.x[0], kept, at.x[2]}); },
         .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(tank, tank.create_context(), {0.0, 11.0}, {.ode_solver_method = method});
  INFO(method << ", kept " << kept);
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.context.continuous_state()[0] == Approx(1.0 + 10.0 * kept).margin(1e-4));
  CHECK(results.context.continuous_state()[2] == Approx(11.0));
}

TEST_CASE("2.1 edge_detection compares with the value at which its mode was entered",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("modes", [](Leaf& l) {
    declare_ramp(l);
    l.declare_default_mode(0);
    const auto step = [](const At& at) { return at.x[0] < 1.0 ? 0.0 : at.x[0] < 3.0 ? 1.0 : 2.0; };
    l.declare_zero_crossing({.name = "enter",
                             .guard = [](const At& at) { return at.x[0] - 2.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "edge",
                             .guard = step,
                             .direction = Direction::edge_detection,
                             .start_mode = 1,
                             .end_mode = 1});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 4.0}, {.ode_solver_method = method});
  REQUIRE(results.events.times("edge").size() == 1);
  CHECK(std::abs(results.events.times("edge")[0] - 3.0) < 100.0 * eps * 4.0);
}
