// Quantizer with hysteresis: its loop, jumps over levels, no chatter, and refusals.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr Quantizer::Options loose{.hysteresis = 0.5};

}  // namespace

/// u = 2 sin t, levels 0, 1, 2: up at 0.75 and 1.75, down from 2 at 1.25, from 1 at 0.25.
TEST_CASE("a level is left half an interval and half a hysteresis away from it",
          "[library][nonlinear]") {
  const BlockRun<Quantizer> scene(fed_by<Sine>(Sine::Options{.amplitude = 2.0}), 1.0, loose);
  const Results results = scene.run(std::numbers::pi);
  REQUIRE(results.events.size() == 4);
  const double up = std::asin(0.375), next = std::asin(0.875), pi = std::numbers::pi;
  const Numbers expected{up, next, pi - std::asin(0.625), pi - std::asin(0.125)};
  for (std::size_t i = 0; i < 4; ++i)
    CHECK_THAT(results.events[i].time, WithinAbs(expected[i], rounding));
  CHECK(scene.at({0.3, 0.5, 1.2, 2.0, 2.6}) == Numbers{0.0, 1.0, 2.0, 2.0, 1.0});
}

/// The trap: a jump over several levels, up and down, and a start beyond level 0.
TEST_CASE("a jump ends at the nearest level", "[library][nonlinear]") {
  const BlockRun<Quantizer> scene(
      fed_by<Step>(Step::Options{.start_value = -7.2, .end_value = 5.4, .step_time = 1.0}), 1.0,
      loose);
  CHECK(scene.at({0.5, 1.5}) == Numbers{-7.0, 5.0});
  const BlockRun<Quantizer> wide(fed_by<Constant>(Value{0.7, 3.0}), Value{1.0, 2.0}, loose);
  CHECK(at_times(wide.diagram, wide.block->output(), {1.0}, 0)[0] == 0.0);
  CHECK(at_times(wide.diagram, wide.block->output(), {1.0}, 1)[0] == 4.0);
}

/// A ripple of 0.2 about the edge of two levels: without hysteresis it changes the level at each
/// crossing, with 0.5 never.
TEST_CASE("a ripple below the hysteresis changes no level", "[library][nonlinear]") {
  const auto ripple = fed_by<Sine>(Sine::Options{.amplitude = 0.2, .frequency = 50.0, .bias = 0.5});
  const BlockRun<Quantizer> scene(ripple, 1.0, loose);
  CHECK(scene.run(2.0).events.empty());
}

TEST_CASE("a hysteresis of an interval or more is refused", "[library][errors]") {
  CHECK(contains(model_error([] { Quantizer("q", 1.0, {.hysteresis = 1.0}); }),
                 "hysteresis = 1; expected 0, or less than the interval 1"));
  CHECK(contains(model_error([] { Quantizer("q", 1.0, {.hysteresis = -0.1}); }), "hysteresis"));
}
