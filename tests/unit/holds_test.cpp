// Holds: from which firing on a block rests, which of its states rest, and until when.
#include "saltus/simulation/detail/holds.hpp"

#include "support/instants.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A ball that falls from 1 m and bounces at t = 1 s and after each gap; the speed of an impact is
/// that of its flight, 5 gap.
struct Bounces : Instants {
  explicit Bounces(const FloorBall& ball) : Instants(ball.make()) { begin(0.0, vec({1.0, 0.0})); }
  Outcome bounce(double at, double speed) { return fire(at, vec({-1e-16, -speed}), 0, 1); }
  /// The last outcome.
  Outcome after(const std::vector<double>& gaps) {
    Outcome outcome = bounce(t = 1.0, 1.0);
    for (const double gap : gaps) outcome = bounce(t += gap, 5.0 * gap);
    return outcome;
  }
  double t = 0.0;
};

// With the default tolerance a gap has to be short beside the longest one, too.
const std::vector<double> shrinking{1e-3, 8e-7, 4e-7, 2e-7}, equal{1e-3, 4e-7, 4e-7, 4e-7, 4e-7};

}  // namespace

TEST_CASE("gaps that shrink below the tolerance come to rest; equal and long gaps do not",
          "[holds]") {
  CHECK(Bounces({}).after(shrinking).restart);
  struct Row {
    std::vector<double> gaps;
    bool rests;
  };
  const auto row = GENERATE(values<Row>({{shrinking, true},
                                         {equal, false},
                                         {{}, false},
                                         {{4e-7}, false},
                                         {{8e-3, 4e-3, 2e-3}, false}}));
  Bounces ball({});
  ball.after(row.gaps);
  CHECK(ball.at_rest() == row.rests);
  CHECK(ball.count(EventKind::zeno_enter) == row.rests);
  CHECK(ball.count(EventKind::zero_crossing) == static_cast<int>(row.gaps.size()) + 1);
}

TEST_CASE("on entry the time and the state are those of the sum of the series", "[holds]") {
  Bounces ball({});
  ball.after(shrinking);
  const Event last = ball.results.events[ball.results.events.size() - 1];
  REQUIRE(last.kind == EventKind::zeno_enter);
  // The gaps are known to a rounding of the time, 2e-16 of 2e-7: q / (1 - q) = 1 to 1e-8.
  CHECK_THAT(last.predicted, WithinAbs(ball.t + 2e-7, 1e-14));
  CHECK(ball.machine.x[0] == 0.0);
  CHECK_THAT(ball.machine.x[1], WithinAbs(0.0, 1e-13));
}

TEST_CASE("a flow that leads straight back rests at the first impact", "[holds]") {
  Bounces ball({.e = 0.0});
  CHECK(ball.after({}).restart);
  CHECK(ball.at_rest());
  CHECK(ball.results.events[ball.results.events.size() - 1].predicted == 1.0);
}

TEST_CASE("without a tolerance nothing rests, and a flow that leads back is said to be stuck",
          "[holds]") {
  Bounces bouncing({.zeno_tolerance = 0.0}), stopped({.e = 0.0, .zeno_tolerance = 0.0});
  CHECK_FALSE(bouncing.after(shrinking).stuck);
  CHECK(stopped.after({}).stuck);
  CHECK_FALSE(bouncing.machine.resting().any());
  CHECK_FALSE(stopped.machine.resting().any());
}

TEST_CASE("the tolerance of a guard goes before that of the options", "[holds]") {
  Bounces ball({.zeno_tolerance = 1e-2});
  ball.after({8e-3, 4e-3, 2e-3});
  CHECK(ball.at_rest());
}

TEST_CASE("an author chooses how a guard goes on at its Zeno point", "[holds]") {
  SECTION("stop") {
    Bounces ball({.on_zeno = OnZeno::stop()});
    CHECK(ball.after(shrinking).zeno_stop);
    CHECK_FALSE(ball.machine.resting().any());
    CHECK(ball.count(EventKind::zeno_enter) == 1);
    CHECK_THAT(ball.machine.x[1], WithinAbs(0.0, 1e-13));  // the sum of the series
  }
  SECTION("error") {
    Bounces ball({.on_zeno = OnZeno::error()});
    const auto error = message<SimulationError>([&] { ball.after(shrinking); });
    CHECK(contains(error, "the firings of 'ball.bounce' accumulate at t = 1"));
    CHECK(contains(error, "choose \"hold\", \"stop\" or a mode"));
  }
  SECTION("a mode") {
    Bounces ball({.on_zeno = OnZeno::enter(4)});
    CHECK(ball.after(shrinking).restart);
    CHECK(ball.machine.modes[0] == 4);
  }
  SECTION("a mode, entered where the flow leads straight back") {
    Bounces ball({.e = 0.0, .on_zeno = OnZeno::enter(4)});
    ball.after({});
    CHECK(ball.machine.modes[0] == 4);
  }
}

TEST_CASE("`holds` decides which states rest; the others flow on", "[holds]") {
  Bounces ball({.holds = {{1}}});
  ball.after(shrinking);
  CHECK_FALSE(ball.machine.resting().rests(0));
  CHECK(ball.machine.resting().rests(1));
}

TEST_CASE("after two firings the next one is looked for within a little more than their gap",
          "[holds]") {
  Bounces ball({});
  CHECK(ball.after({}).horizon == infinite);
  const Outcome second = ball.bounce(1.0 + 1e-3, 5e-3);
  CHECK(second.horizon >= 1e-3);
  CHECK(second.horizon <= 2e-3);
}

TEST_CASE("a hold ends where the surface falls away, and the motion begins from the held state",
          "[holds]") {
  Bounces ball({.e = 0.0, .step = -0.5});
  ball.after({});
  const Outcome outcome = ball.tick(2.0, vec({0.0, 0.0}), FloorBall::move);
  CHECK(outcome.restart);
  CHECK_FALSE(ball.machine.resting().any());
  CHECK(ball.machine.x == vec({0.0, 0.0}));
  CHECK(ball.count(EventKind::zeno_release) == 1);
  CHECK(ball.guards[0].side == 1);
}

TEST_CASE("a surface that rises under a block carries it, and the hold goes on", "[holds]") {
  Bounces ball({.e = 0.0, .step = 0.25});
  ball.after({});
  ball.tick(2.0, vec({0.0, 0.0}), FloorBall::move);
  CHECK(ball.at_rest());
  CHECK(ball.machine.x == vec({0.25, 0.0}));
  CHECK(ball.count(EventKind::zeno_release) == 0);
  CHECK(ball.count(EventKind::zero_crossing) == 2);
}

TEST_CASE("a hold ends where its states are written, and not where others are", "[holds]") {
  Bounces ball({.e = 0.0});
  ball.after({});
  ball.tick(2.0, vec({0.0, 0.0}), FloorBall::count);
  CHECK(ball.at_rest());
  ball.tick(3.0, vec({0.0, 0.0}), FloorBall::push);
  CHECK_FALSE(ball.machine.resting().any());
  CHECK(ball.machine.x == vec({0.0, 3.0}));
}

TEST_CASE("after a release earlier firings have no meaning", "[holds]") {
  Bounces ball({});
  ball.after(shrinking);
  REQUIRE(ball.at_rest());
  ball.tick(ball.t + 5e-8, ball.machine.x, FloorBall::push);
  ball.bounce(ball.t + 1e-7, 1.0);  // the gaps go on to shrink
  CHECK_FALSE(ball.machine.resting().any());
}

TEST_CASE("a continued run rests where the earlier one did, and remembers its gaps", "[holds]") {
  Bounces earlier({});
  earlier.after({1e-3, 8e-7, 4e-7});
  Bounces later({});
  later.machine.x = earlier.machine.x;
  const Continuation between = earlier.instant.save();
  REQUIRE(later.instant.fits(between));
  later.instant.resume(earlier.t, nullptr, between, 10.0);
  CHECK_FALSE(later.machine.resting().any());
  later.bounce(earlier.t + 2e-7, 1e-6);
  CHECK(later.at_rest());

  Bounces last({});
  last.machine.x = later.machine.x;
  last.instant.resume(2.0, nullptr, later.instant.save(), 10.0);
  CHECK(last.at_rest());
  last.tick(2.0, last.machine.x, FloorBall::move);
  CHECK_FALSE(last.machine.resting().any());
}
