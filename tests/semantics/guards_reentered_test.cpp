// Semantics 3.7: a guard that is seen again, because its mode is entered or because its part of the
// diagram is enabled. What begins to move at the surface begins in contact: nothing falls through it.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;
enum Mode { falling, frozen };

struct Start {
  double height, speed;
  Mode mode;
};

/// A ball over the floor that does not move in mode `frozen`, in which its bounce is not seen. It is
/// frozen at 3, 6, ... s and falls again at 1.5, 4.5, ... s.
Leaf ball_with_modes(double e, double floor) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_default_mode(falling);
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << (at.mode == falling ? at.x[1] : 0.0), (at.mode == falling ? -g : 0.0);
         }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [=](const At& at) { return at.x[0] - floor; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({floor, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = falling});
    const auto enter = [](int mode) { return [=](const At&, Next& next) { next.set_mode(mode); }; };
    l.declare_periodic_update(enter(frozen), 3.0, 3.0, "freeze");
    l.declare_periodic_update(enter(falling), 3.0, 1.5, "fall");
  });
}

/// The same ball without modes, in a part that is executed while a pulse of 3 s is on.
struct EnabledBall {
  EnabledBall(double e, double floor) : leaf(make(e, floor)) {
    DiagramBuilder builder;
    builder.add(leaf);
    const auto& pulse =
        builder.add<Pulse>("pulse", PulseOptions{.period = 3.0, .phase_delay = 1.5});
    builder.execute(*leaf, pulse.output(), {});
    diagram.emplace(builder.build());
  }
  static std::shared_ptr<Leaf> make(double e, double floor) {
    return std::make_shared<Leaf>("ball", [=](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
      l.declare_zero_crossing(
          {.name = "bounce",
           .guard = [=](const At& at) { return at.x[0] - floor; },
           .reset_map = [=](const At& at,
                            Next& next) { next.set_continuous_state({floor, -e * at.x[1]}); },
           .direction = Direction::positive_then_non_positive});
    });
  }
  std::shared_ptr<Leaf> leaf;
  std::optional<Diagram> diagram;
};

/// At rest on the floor, within the rounding of its height and of a fall for some roundings of t.
void check_rests(const Results& results, double floor) {
  const Eigen::VectorXd& x = results.context.continuous_state();
  CHECK(std::abs(x[0] - floor) <= 1e-9);
  CHECK(std::abs(x[1]) <= 1e-9);
}

}  // namespace

TEST_CASE("3.7 a ball that rests goes on resting when its guard is seen again", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const double floor : {0.0, 3.3, -0.1}) {
    for (const double e : {0.0, 0.3, 0.5}) {
      INFO(method << ", e = " << e << ", floor " << floor);
      const Leaf ball = ball_with_modes(e, floor);
      const auto high = ball.create_context().with_continuous_state(vec({floor + 0.5, 0.0}));
      check_rests(simulate(ball, high, {0.0, 20.0}, {.ode_solver_method = method}), floor);
      const EnabledBall part(e, floor);
      const auto start =
          part.diagram->create_context().with_continuous_state(vec({floor + 0.5, 0.0}));
      check_rests(simulate(*part.diagram, start, {0.0, 20.0}, {.ode_solver_method = method}),
                  floor);
    }
  }
}

/// v = -2 m/s on the floor at 1.5 s, when it may move: it bounces at once.
TEST_CASE("3.7 a ball that is let go on the floor, with a speed into it, bounces", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double e = 0.5;
  const Leaf ball = ball_with_modes(e, 0.0);
  const auto held = ball.create_context().with_continuous_state(vec({0.0, -2.0})).with_mode(frozen);
  const EnabledBall part(e, 0.0);
  const auto off = part.diagram->create_context().with_continuous_state(vec({0.0, -2.0}));
  for (const Results& results :
       {simulate(ball, held, {0.0, 1.6}, {.ode_solver_method = method}),
        simulate(*part.diagram, off, {0.0, 1.6}, {.ode_solver_method = method})}) {
    INFO(method);
    CHECK(results.events.times("bounce") == std::vector<double>{1.5});
    const double t = 1.6 - 1.5, v = e * 2.0;
    // One-step methods are exact on a parabola. The first steps of the multistep methods are not.
    CHECK(std::abs(results.context.continuous_state()[0] - (v * t - 0.5 * g * t * t)) <= 1e-6);
  }
}

/// The flow before led through the surface too: the guard of the mode that is entered is passed.
TEST_CASE("3.7 a mode that is entered on the way through its surface is not left at once",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At&) { return -1.0; }});
    for (const int from : {0, 1}) {
      l.declare_zero_crossing({.name = from == 0 ? "first" : "second",
                               .guard = [](const At& at) { return at.x[0]; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = from,
                               .end_mode = from + 1});
    }
  });
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  CHECK(results.events.times("first").size() == 1);
  CHECK(results.events.times("second").empty());
}

namespace {

/// x' = 1 in mode 0, `rate` in mode 1. "there" resets x to `to` and enters mode 1; "back", which this moves
/// across its level at 0.2, enters mode 0 again in the same instant.
Leaf there_and_back(std::optional<int> seen_in, double to, double rate, bool back_resets) {
  return Leaf("leaf", [=](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state(
        {.initial = vec({-0.5}), .ode = [=](const At& at) { return at.mode == 0 ? 1.0 : rate; }});
    l.declare_zero_crossing(
        {.name = "there",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At&, Next& next) { next.set_continuous_state({to}); },
         .direction = Direction::negative_then_non_negative,
         .start_mode = seen_in,
         .end_mode = 1});
    ZeroCrossing back{.name = "back",
                      .guard = [](const At& at) { return at.x[0] - 0.2; },
                      .direction = Direction::negative_then_non_negative,
                      .end_mode = 0};
    if (back_resets)
      back.reset_map = [=](const At&, Next& next) { next.set_continuous_state({to}); };
    l.declare_zero_crossing(back);
  });
}

}  // namespace

/// "there" is beyond zero when its mode is entered again: it waits until it has been on its armed side. It
/// never is, because x' = 1.
TEST_CASE("3.7 a mode that is left and entered again in one instant is entered", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const std::optional<int> seen_in : {std::optional<int>(0), std::optional<int>()})
    for (const double to : {0.4, 5.0})
      for (const double rate : {-0.6, 0.6, 1.0})
        for (const bool back_resets : {false, true}) {
          INFO(method << ", reset to " << to << ", rate " << rate << ", the second resets "
                      << back_resets);
          const Leaf leaf = there_and_back(seen_in, to, rate, back_resets);
          const Results results =
              simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
          CHECK(results.events.times("there").size() == 1);
          CHECK(results.events.times("back").size() == 1);
          CHECK(results.context.mode() == 0);
          // Where a straight line begins and ends has the rounding of the root, of either time.
          CHECK(std::abs(results.context.continuous_state()[0] - (to + 0.5)) <= 1e-12);
        }
}

/// x falls from 1. "leave" enters mode 1 at x = 0, where the guard "fires" is seen, with the value z + 0.5: on its
/// armed side. A third guard carries it across.
TEST_CASE("3.7 a guard that fires in the instant in which its mode is entered fires once",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.mode == 0 ? -1.0 : 1.0; }});
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_zero_crossing(
        {.name = "leave",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({1.0, at.z[1]}); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = 0,
         .end_mode = 1});
    l.declare_zero_crossing(
        {.name = "carry",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.z[0] + 1.0, at.z[1]}); },
         .direction = Direction::negative_then_non_negative});
    // It turns with the mode: in mode 0 its slope is -1, in mode 1 +1.
    l.declare_zero_crossing(
        {.name = "fires",
         .guard = [](const At& at) { return at.x[0] - 1.5 + at.z[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.z[0], at.z[1] + 1.0}); },
         .direction = Direction::negative_then_non_negative,
         .start_mode = 1});
  });
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 1.25}, {.ode_solver_method = method});
  for (const char* name : {"leave", "carry", "fires"})
    CHECK(results.events.times(name).size() == 1);
  CHECK(results.context.discrete_state() == vec({2.0, 1.0}));
}
