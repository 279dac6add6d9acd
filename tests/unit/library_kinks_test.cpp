// Sign, MinMax, DeadZone, Quantizer: values, and their kinks, located only where they reach a
// derivative.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"
#include "saltus/library/dead_zone.hpp"
#include "saltus/library/min_max.hpp"
#include "saltus/library/quantizer.hpp"
#include "saltus/library/sign.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double pi = std::numbers::pi;

const auto sine = fed_by<Sine>(Sine::Options{});
const auto large_sine = fed_by<Sine>(Sine::Options{.amplitude = 2.0});

/// sin t, cos t and 0 in front of a block of three inputs.
const auto three = [](DiagramBuilder& builder, auto& block) {
  builder.connect(builder.add<Sine>("sine").output(), block.input(0));
  builder.connect(builder.add<Sine>("cosine", Sine::Options{.phase = pi / 2.0}).output(),
                  block.input(1));
  builder.connect(builder.add<Constant>("zero", 0.0).output(), block.input(2));
};

}  // namespace

TEST_CASE("Sign is -1, 0 or 1, and its integral is exact", "[library][kinks]") {
  CHECK(Bench<Sign>({Value{-2.0, 0.0, 3.0}}).output() == Numbers{-1.0, 0.0, 1.0});
  CHECK_THAT(integral<Sign>(4.0, sine), WithinAbs(pi - (4.0 - pi), rounding));
}

TEST_CASE("MinMax gives an extremum of its inputs, entry by entry", "[library][kinks]") {
  const std::vector<Value> u{Value{1.0, 5.0, 2.0}, 3.0, Value{4.0, 4.0, 2.0}};
  CHECK(Bench<MinMax>(u, "max", 3).output() == Numbers{4.0, 5.0, 3.0});
  CHECK(Bench<MinMax>(u, "min", 3).output() == Numbers{1.0, 3.0, 2.0});
  CHECK(contains(model_error([] { MinMax("m", "mean"); }), "unknown operator 'mean'"));
  CHECK(contains(model_error([] { MinMax("m", "max", 0); }), "expected 1 input or more, found 0"));
}

/// max(sin, cos, 0) is cos up to pi/4, sin up to pi, 0 up to 3 pi/2, and then cos.
TEST_CASE("the integral of a maximum of three signals is exact", "[library][kinks]") {
  const double root = std::sqrt(0.5);
  CHECK_THAT(integral<MinMax>(2.0 * pi, three, "max", 3),
             WithinAbs(root + (1.0 + root) + 1.0, solver_tolerance));
}

TEST_CASE("DeadZone passes u outside, or what is beyond the edge", "[library][kinks]") {
  const std::vector<Value> u{Value{-3.0, -1.0, 0.5, 1.0, 3.0}};
  CHECK(Bench<DeadZone>(u).output() == Numbers{-3.0, -1.0, 0.0, 1.0, 3.0});
  CHECK(Bench<DeadZone>(u, DeadZone::Options{.shifted = true}).output() ==
        Numbers{-2.0, 0.0, 0.0, 0.0, 2.0});
  CHECK(contains(model_error([] { DeadZone("d", {.half_range = -1.0}); }), "half_range = -1"));
}

/// Outside the zone 2 sin t is beyond 1 from pi/6 to 5 pi/6: its integral there is 2 sqrt(3).
TEST_CASE("the integrals of both kinds of DeadZone are exact", "[library][kinks]") {
  const double plain = 2.0 * std::sqrt(3.0), edge = 2.0 * pi / 3.0;
  CHECK_THAT(integral<DeadZone>(pi, large_sine), WithinAbs(plain, solver_tolerance));
  CHECK_THAT(integral<DeadZone>(pi, large_sine, DeadZone::Options{.shifted = true}),
             WithinAbs(plain - edge, solver_tolerance));
}

TEST_CASE("Quantizer gives the nearest level, with a level at 0", "[library][kinks]") {
  const std::vector<Value> u{Value{-0.7, -0.2, 0.0, 0.24, 0.26, 0.7, 1.3}};
  CHECK(Bench<Quantizer>(u, 0.5).output() == Numbers{-0.5, 0.0, 0.0, 0.0, 0.5, 0.5, 1.5});
  CHECK(contains(model_error([] { Quantizer("q", 0.0); }),
                 "interval = 0; expected a finite number > 0"));
}

/// A ramp of slope 1 stays half an interval at level 0, then a whole one at each level.
TEST_CASE("the integral of a quantized ramp is exact, up and down", "[library][kinks]") {
  const auto ramp = [](double slope) {
    return fed_by<Ramp>(Ramp::Options{.slope = slope, .start_time = 0.0});
  };
  CHECK_THAT(integral<Quantizer>(3.0, ramp(1.0), 1.0), WithinAbs(1.0 + 2.0 + 1.5, rounding));
  CHECK_THAT(integral<Quantizer>(3.0, ramp(-1.0), 1.0), WithinAbs(-4.5, rounding));
}

/// Levels that a step of the solver could pass in one go: the derivative of the signal is 50
/// intervals a second.
TEST_CASE("a fine quantizer loses no level", "[library][kinks]") {
  const auto ramp = fed_by<Ramp>(Ramp::Options{.slope = 1.0, .start_time = 0.0});
  CHECK_THAT(integral<Quantizer>(2.0, ramp, 0.02), WithinAbs(2.0, rounding));
}

TEST_CASE("a kink that reaches no derivative costs no root-finding", "[library][kinks]") {
  const auto guards = [](const auto& bench) { return bench.plan().guards.size(); };
  CHECK(guards(Bench<Sign>({1.0})) == 0);
  CHECK(guards(Bench<MinMax>({1.0, 2.0}, "max")) == 0);
  CHECK(guards(Bench<DeadZone>({1.0})) == 0);
  CHECK(guards(Bench<Quantizer>({1.0}, 1.0)) == 0);
}
