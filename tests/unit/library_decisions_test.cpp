// Relay, IfThenElse, MultiportSwitch, Counter, Stop, HitCrossing, RateLimiter: what they choose, and
// when.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"
#include "saltus/library/counter.hpp"
#include "saltus/library/hit_crossing.hpp"
#include "saltus/library/if_then_else.hpp"
#include "saltus/library/multiport_switch.hpp"
#include "saltus/library/rate_limiter.hpp"
#include "saltus/library/relay.hpp"
#include "saltus/library/stop.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double pi = std::numbers::pi;

const auto sine = fed_by<Sine>(Sine::Options{});
const auto clock_in = fed_by<Clock>();

Relay::Options levels(double on, double off) {
  return {.on_threshold = on, .off_threshold = off, .on_value = 2.0, .off_value = -1.0};
}

/// sin t > 0.5 in front of a block.
const auto above_half = [](DiagramBuilder& builder, auto& block) {
  auto& compare = builder.add<Comparator>("above", ">");
  builder.connect(builder.add<Sine>("sine").output(), compare.input(0));
  builder.connect(builder.add<Constant>("half", 0.5).output(), compare.input(1));
  builder.connect(compare.output(), block.input());
};

}  // namespace

/// sin t reaches 0.5 at pi/6 and -0.5 at 7 pi/6.
TEST_CASE("a Relay switches at its thresholds, with hysteresis", "[library][logic]") {
  const BlockRun<Relay> scene(sine, levels(0.5, -0.5));
  CHECK(scene.at({0.5, 0.6, 3.5, 3.7}) == Numbers{-1.0, 2.0, 2.0, -1.0});
  const auto results = scene.run(7.0);
  CHECK_THAT(results.events.times("block.turn_on")[0], WithinAbs(pi / 6.0, rounding));
  CHECK_THAT(results.events.times("block.turn_off")[0], WithinAbs(7.0 * pi / 6.0, rounding));
  CHECK_THAT(integral<Relay>(2.0 * pi, sine, levels(0.5, -0.5)),
             WithinAbs(2.0 * pi - 1.0 * pi, 10.0 * rounding));
}

TEST_CASE("a Relay that starts beyond a threshold has that side from the start",
          "[library][logic]") {
  const auto start = [](double u, bool initially_on) {
    Relay::Options options = levels(1.0, 0.0);
    options.initially_on = initially_on;
    return BlockRun<Relay>(fed_by<Constant>(u), options).at({0.0, 1.0});
  };
  CHECK(start(1.5, false) == Numbers{2.0, 2.0});
  CHECK(start(1.0, false) == Numbers{2.0, 2.0});
  CHECK(start(-0.5, true) == Numbers{-1.0, -1.0});
  CHECK(start(0.5, false) == Numbers{-1.0, -1.0});
  CHECK(start(0.5, true) == Numbers{2.0, 2.0});
}

TEST_CASE("a Relay follows a held signal that jumps", "[library][logic]") {
  const BlockRun<Relay> scene(fed_by<Pulse>(Pulse::Options{.amplitude = 2.0, .period = 2.0}),
                              levels(1.0, 0.5));
  CHECK(scene.at({0.5, 1.5, 2.5, 3.5}) == Numbers{2.0, -1.0, 2.0, -1.0});
}

/// x' = -sign(x) by a relay without hysteresis: no time can pass between its switches.
TEST_CASE("a Relay with equal thresholds in a loop ends as chattering", "[library][logic]") {
  DiagramBuilder builder;
  auto& relay = builder.add<Relay>(
      "relay", Relay::Options{
                   .on_threshold = 0.0, .off_threshold = 0.0, .on_value = -1.0, .off_value = 1.0});
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 1.0});
  builder.connect(x.output(), relay.input());
  builder.connect(relay.output(), x.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.throw_errors = false});
  CHECK(results.status == Status::chattering);
  CHECK(contains(model_error([] { Relay("r", levels(0.0, 1.0)); }),
                 "off_threshold 1 is not below on_threshold 0"));
}

TEST_CASE("IfThenElse chooses entry by entry", "[library][logic]") {
  const Value a{1.0, 2.0}, b{3.0, 4.0};
  CHECK(Bench<IfThenElse>({1.0, a, b}).output() == Numbers{1.0, 2.0});
  CHECK(Bench<IfThenElse>({0.0, a, 5.0}).output() == Numbers{5.0, 5.0});
}

TEST_CASE("MultiportSwitch takes the nearest of its inputs", "[library][logic]") {
  const auto chosen = [](double control) {
    return Bench<MultiportSwitch>({control, 10.0, Value{20.0, 21.0}, 30.0}, 3).output();
  };
  CHECK(chosen(0.0) == Numbers{10.0, 10.0});
  CHECK(chosen(0.6) == Numbers{20.0, 21.0});
  CHECK(chosen(1.4) == Numbers{20.0, 21.0});
  CHECK(chosen(2.0) == Numbers{30.0, 30.0});
  CHECK(chosen(-7.0) == Numbers{10.0, 10.0});
  CHECK(chosen(9.0) == Numbers{30.0, 30.0});
  CHECK(contains(model_error([] { MultiportSwitch("m", 0); }), "expected 1 input or more"));
}

/// The control is t: 1 up to 0.5 s, 2 up to 1.5 s, then 4.
TEST_CASE("the integral over the switches of a MultiportSwitch is exact", "[library][logic]") {
  const auto inputs = [](DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Clock>("clock").output(), block.input(0));
    for (int k = 0; k < 3; ++k)
      builder.connect(builder.add<Constant>(text("c", k), std::exp2(k)).output(),
                      block.input(k + 1));
  };
  CHECK_THAT(integral<MultiportSwitch>(3.0, inputs, 3), WithinAbs(0.5 + 2.0 + 6.0, rounding));
}

TEST_CASE("Counter counts edges", "[library][logic]") {
  const std::vector<double> times{1.0, 3.0, 7.0, 13.5};
  CHECK(BlockRun<Counter>(above_half).at(times) == Numbers{1.0, 1.0, 2.0, 3.0});
  CHECK(BlockRun<Counter>(above_half, Counter::Options{.edge = Edge::either}).at(times) ==
        Numbers{1.0, 2.0, 3.0, 5.0});
  CHECK(BlockRun<Counter>(above_half, Counter::Options{.limit = 2}).at(times) ==
        Numbers{1.0, 1.0, 0.0, 1.0});
  CHECK(contains(model_error([] { Counter("c", {.limit = 0}); }), "limit = 0"));
}

TEST_CASE("Stop ends the run when its input becomes true", "[library][logic]") {
  const auto results = BlockRun<Stop>(above_half).run(10.0);
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(pi / 6.0, rounding));
  CHECK(BlockRun<Stop>(fed_by<Constant>(1.0)).run(10.0).context.time() == 0.0);
  CHECK(BlockRun<Stop>(fed_by<Constant>(0.0)).run(10.0).status == Status::reached_end);
}

TEST_CASE("HitCrossing logs and changes nothing", "[library][logic]") {
  const BlockRun<HitCrossing> both(sine, HitCrossing::Options{.offset = 0.5});
  const auto hits = both.run(6.0).events.times("block.hit");
  REQUIRE(hits.size() == 2);
  CHECK_THAT(hits[0], WithinAbs(pi / 6.0, rounding));
  CHECK_THAT(hits[1], WithinAbs(5.0 * pi / 6.0, rounding));
  const BlockRun<HitCrossing> falling(
      sine,
      HitCrossing::Options{.offset = 0.5, .direction = Direction::positive_then_non_positive});
  CHECK(falling.run(6.0).events.times("block.hit").size() == 1);
}

/// u = t after 0.95 s, sampled each 0.1 s: y climbs by 0.05 a tick from u(0) = 0.
TEST_CASE("RateLimiter follows with limited rates, exactly", "[library][discrete]") {
  const BlockRun<RateLimiter> up(clock_in, 0.1, RateLimiter::Options{.upper_limit = 0.5});
  const Numbers y = up.at({0.05, 0.15, 0.95});
  CHECK(y[0] == 0.0);
  CHECK_THAT(y[1], WithinAbs(0.05, rounding));
  CHECK_THAT(y[2], WithinAbs(0.45, rounding));
  const BlockRun<RateLimiter> down(
      fed_by<Step>(Step::Options{.start_value = 4.0, .end_value = 0.0}), 0.25,
      RateLimiter::Options{.lower_limit = -2.0});
  CHECK(down.at({0.1, 1.1, 1.3, 9.0}) == Numbers{4.0, 3.5, 3.0, 0.0});
  CHECK(contains(model_error([] { RateLimiter("r", 0.0); }), "dt = 0 s"));
  CHECK(contains(model_error([] { RateLimiter("r", 1.0, {.lower_limit = 2.0}); }),
                 "lower_limit 2 /s is above upper_limit 1 /s"));
}
