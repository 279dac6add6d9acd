// ContactGuards: a block at rest on a surface that moves is carried, and let go in time.
#include "saltus/simulation/detail/contact_guards.hpp"

#include "support/instants.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A ball that does not bounce, under g = 10 m/s^2, over a floor with the height h(t) and the speed
/// h'(t).
template <class Height, class Speed>
std::shared_ptr<Leaf> over(Height h, Speed speed) {
  return std::make_shared<Leaf>("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0; }});
    l.declare_zero_crossing(
        {.name = "floor",
         .guard = [=](const At& at) { return at.x[0] - h(at.time); },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({h(at.time), speed(at.time)}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// h = a t^2 / 2.
std::shared_ptr<Leaf> accelerated(double a) {
  return over([=](double t) { return 0.5 * a * t * t; }, [=](double t) { return a * t; });
}

}  // namespace

TEST_CASE(
    "a block rests on a floor at rest, is carried by one that moves, and leaves one that "
    "falls faster than it does",
    "[contact_guards]") {
  struct Row {
    double acceleration;
    bool rests, carried;
  };
  const auto row = GENERATE(values<Row>({{0.0, true, false},
                                         {2.0, true, true},
                                         {-5.0, true, true},
                                         {-9.9, true, true},
                                         {-10.1, false, false},
                                         {-20.0, false, false}}));
  INFO("acceleration " << row.acceleration);
  Instants run(accelerated(row.acceleration));
  run.begin(0.0, vec({0.0, 0.0}));
  CHECK(run.machine.resting().any() == row.rests);
  CHECK(run.machine.carries() == row.carried);
  if (!row.carried) return;
  double x[] = {7.0, 7.0};
  run.machine.put_carried(0.5, x);
  CHECK_THAT(x[0], WithinAbs(0.125 * row.acceleration, 1e-15));
  CHECK_THAT(x[1], WithinAbs(0.5 * row.acceleration, 1e-15));
}

TEST_CASE("a carried block presses on its floor until its lift rises to zero", "[contact_guards]") {
  // h = -t^3: the floor falls with 6 t, so a block presses until t = 10 / 6.
  Instants run(over([](double t) { return -t * t * t; }, [](double t) { return -3.0 * t * t; }));
  run.begin(0.0, vec({0.0, 0.0}));
  REQUIRE(run.machine.carries());
  const auto lift = [&](double t) {
    double g = 0.0;
    run.machine.guards(t, run.machine.x.data(), &g);
    return g;
  };
  CHECK(run.guards[0].phase == Phase::carried);
  CHECK(lift(1.0) < 0.0);
  CHECK(lift(1.6) < 0.0);
  CHECK(lift(1.7) > 0.0);
  run.machine.put_carried(1.7, run.machine.x.data());
  const Outcome outcome = run.fire(1.7, run.machine.x, 0, -1);
  CHECK(outcome.restart);
  CHECK_FALSE(run.machine.carries());
  CHECK_FALSE(run.machine.resting().any());
  CHECK(run.count(EventKind::zeno_release) == 1);
  CHECK_THAT(run.machine.x[0], WithinAbs(-1.7 * 1.7 * 1.7, 1e-14));
  CHECK(run.guards[0].side == 1);
}

TEST_CASE("a guard at rest that wavers by rounding releases nothing", "[contact_guards]") {
  Instants run(FloorBall{.e = 0.0}.make());
  run.begin(0.0, vec({0.0, 0.0}));
  REQUIRE(run.at_rest());
  run.fire(1.0, vec({0.0, 0.0}), 0, -1);
  CHECK(run.at_rest());
  CHECK(run.count(EventKind::zeno_release) == 0);
}

TEST_CASE("a release is an event of the guard that held the block", "[contact_guards]") {
  Instants run(FloorBall{.e = 0.0}.make());
  run.begin(0.0, vec({0.0, 0.0}));
  run.tick(1.0, vec({0.0, 0.0}), FloorBall::move);
  const Event last = run.results.events[run.results.events.size() - 1];
  CHECK(last.kind == EventKind::zeno_release);
  CHECK(last.time == 1.0);
  CHECK(last.name == "bounce");
}

TEST_CASE("a continued run carries the block that the earlier one carried", "[contact_guards]") {
  Instants earlier(accelerated(2.0)), later(accelerated(2.0));
  earlier.begin(0.0, vec({0.0, 0.0}));
  later.instant.resume(0.0, nullptr, earlier.instant.save(), 10.0);
  CHECK(later.machine.carries());
  CHECK(later.guards[0].phase == Phase::carried);
}
