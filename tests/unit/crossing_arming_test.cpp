// CrossingArming: a guard that begins at zero or beyond it fires, waits or rests as the flow says.
#include "saltus/simulation/detail/crossing_arming.hpp"

#include "support/instants.hpp"

using namespace saltus;
using namespace support;

namespace {

enum class Effect { none, mode, reset };  // none: it would end the run if it fired often

/// A point at height x[0] with speed x[1] under the acceleration `a`, and a guard at the height
/// that falls; its reset map turns the speed round.
std::shared_ptr<Leaf> point(double a, Effect effect, AtStart at_start = AtStart::automatic) {
  return std::make_shared<Leaf>("point", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0, 0.0}),
                                .ode = [a](const At& at, VectorRef xdot) { xdot << at.x[1], a; }});
    ZeroCrossing crossing{.name = "floor",
                          .guard = [](const At& at) { return at.x[0]; },
                          .direction = Direction::positive_then_non_positive,
                          .at_start = at_start};
    if (effect == Effect::none) crossing.terminal = true, crossing.max_count = 100;
    if (effect == Effect::mode) crossing.end_mode = 1;
    if (effect == Effect::reset)
      crossing.reset_map = [](const At& at, Next& next) {
        next.set_continuous_state({at.x[0], std::abs(at.x[1])});
      };
    l.declare_zero_crossing(std::move(crossing));
  });
}

}  // namespace

TEST_CASE(
    "a guard at zero at the start fires at once if the flow takes it to its firing side and "
    "it has an effect",
    "[crossing_arming]") {
  struct Row {
    const char* what;
    double speed, acceleration;
    Effect effect;
    int firings, side;
    bool rests;
  };
  const auto row = GENERATE(values<Row>({
      {"thrown down", -1.0, -10.0, Effect::reset, 1, 1, false},
      {"thrown up", 1.0, -10.0, Effect::reset, 0, 1, false},
      {"at rest", 0.0, -10.0, Effect::reset, 1, 1, true},
      {"lifted off", 0.0, 10.0, Effect::reset, 0, 1, false},
      {"dormant", 0.0, 0.0, Effect::reset, 0, 1, false},
      {"no effect, thrown down", -1.0, -10.0, Effect::none, 0, -1, false},
      {"no effect, thrown up", 1.0, -10.0, Effect::none, 0, 1, false},
  }));
  INFO(row.what);
  Instants run(point(row.acceleration, row.effect));
  run.begin(0.0, vec({0.0, row.speed}));
  CHECK(run.count(EventKind::zero_crossing) == row.firings);
  CHECK(run.at_rest() == row.rests);
  if (!row.rests) CHECK(run.guards[0].side == row.side);
  CHECK(run.guards[0].waits());
}

TEST_CASE("a guard beyond zero at the start does not fire until it has been on its armed side",
          "[crossing_arming]") {
  Instants run(point(-10.0, Effect::reset));
  run.begin(0.0, vec({-1.0, 5.0}));
  CHECK(run.count(EventKind::zero_crossing) == 0);
  CHECK_FALSE(run.guards[0].crossed(-0.5));
  CHECK_FALSE(run.guards[0].crossed(-2.0));
  run.guards.follow(0, 0.1);
  CHECK(run.guards[0].crossed(0.0));
}

TEST_CASE("an author decides both cases otherwise", "[crossing_arming]") {
  struct Row {
    const char* what;
    AtStart wish;
    double height, speed;
    int firings;
    bool refused;
  };
  const auto row = GENERATE(values<Row>({
      {"ignore, at zero", AtStart::ignore, 0.0, -1.0, 0, false},
      {"ignore, beyond", AtStart::ignore, -1.0, -1.0, 0, false},
      {"fire, at zero", AtStart::fire, 0.0, 1.0, 1, false},
      {"fire, beyond", AtStart::fire, -1.0, 1.0, 1, false},
      {"error, at zero", AtStart::error, 0.0, 1.0, 0, true},
      {"error, beyond", AtStart::error, -1.0, 1.0, 0, true},
      {"error, off zero", AtStart::error, 1.0, -1.0, 0, false},
      {"fire, off zero", AtStart::fire, 1.0, -1.0, 0, false},
  }));
  INFO(row.what);
  Instants run(point(-10.0, Effect::reset, row.wish));
  const auto begin = [&] { run.begin(0.0, vec({row.height, row.speed})); };
  if (row.refused) {
    CHECK(contains(message<SimulationError>(begin), "its at_start is \"error\""));
  } else {
    begin();
    CHECK(run.count(EventKind::zero_crossing) == row.firings);
  }
}

TEST_CASE(
    "a reset that turns the flow round arms the guard on its armed side, a rounding beyond "
    "zero or before it",
    "[crossing_arming]") {
  const double height = GENERATE(-1e-17, 0.0, 1e-17);
  Instants run(point(-10.0, Effect::reset));
  run.begin(0.0, vec({1.0, 0.0}));
  run.fire(0.4, vec({height, -4.0}), 0, 1);
  CHECK(run.guards[0].side == 1);
  CHECK_FALSE(run.guards[0].crossed(height));
  run.guards.follow(0, 0.1);
  CHECK(run.guards[0].phase == Phase::armed);
  CHECK(run.guards[0].crossed(0.0));
}

TEST_CASE("a guard that was merely passed through waits on the other side", "[crossing_arming]") {
  Instants run(point(-10.0, Effect::mode));
  run.begin(0.0, vec({1.0, 0.0}));
  CHECK(run.guards[0].side == 1);
  run.fire(0.4, vec({-1e-16, -4.0}), 0, 1);
  CHECK(run.guards[0].side == -1);
  CHECK_FALSE(run.guards[0].crossed(-1.0));
  CHECK_FALSE(run.machine.resting().any());
}

TEST_CASE("a false root while the flow leads to the armed side is no event", "[crossing_arming]") {
  // The guard waits after a bounce at t = 0.4 s. A root within its error, while the point rises,
  // comes from the interpolant.
  Instants run(point(-10.0, Effect::reset));
  run.begin(0.0, vec({1.0, 0.0}));
  run.fire(0.4, vec({0.0, -4.0}), 0, 1);
  const int events = run.count(EventKind::zero_crossing);
  run.fire(0.4 + 1e-12, vec({-1e-20, 4.0}), 0, 1);
  CHECK(run.count(EventKind::zero_crossing) == events);
  CHECK(run.guards[0].phase == Phase::waiting);
  CHECK(run.guards[0].side == 1);
}
