// Semantics 4.5: a block at rest stays on its surface, and nothing is logged of it until the surface
// lets it go.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

/// A ball over the floor h(t), whose bounce puts it on the floor, or with `mirrored` as far above
/// the floor as it was below.
Leaf ball_over(std::function<double(double)> h, std::function<double(double)> speed, double e,
               bool mirrored) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({10.0, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [=](const At& at) { return at.x[0] - h(at.time); },
         .reset_map =
             [=](const At& at, Next& next) {
               const double floor = h(at.time), v = speed(at.time);
               next.set_continuous_state(
                   {mirrored ? floor + std::abs(at.x[0] - floor) : floor, v - e * (at.x[1] - v)});
             },
         .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("4.5 a ball that has come to rest stays on the floor, whatever the rounding of its place",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool mirrored = GENERATE(true, false);
  const double floor = GENERATE(0.0, 3.0);
  // Each restitution ends with another rounding of the height: about one in seventy was released.
  for (int i = 0; i < 150; ++i) {
    const double e = 0.02 + 0.55 * i / 149.0;
    const Leaf ball =
        ball_over([=](double) { return floor; }, [](double) { return 0.0; }, e, mirrored);
    const auto start = ball.create_context().with_continuous_state(vec({floor + 10.0, 0.0}));
    const auto results = simulate(ball, start, {0.0, 12.0}, {.ode_solver_method = method});
    INFO(method << ", e = " << e << ", mirrored " << mirrored << ", floor " << floor);
    CHECK(count(results.events, EventKind::zeno_enter) == 1);
    CHECK(count(results.events, EventKind::zeno_release) == 0);
    // A root is located to a few roundings of the time, in which the ball falls at 14 m/s.
    const double located = 14.0 * 16.0 * eps * 2.0 + 4.0 * eps * floor;
    CHECK(std::abs(results.context.continuous_state()[0] - floor) <= located);
    // The fixed point of the reset map is found to a few roundings of the last speed, which is below
    // g times the Zeno tolerance of 1e-6 s.
    CHECK(std::abs(results.context.continuous_state()[1]) <= 64.0 * eps * g * 1e-6);
  }
}

TEST_CASE("4.5 a ball at rest is carried by a floor that begins to move, without a release",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double a = GENERATE(1.0, 20.0, -1.0, -9.0);  // [m/s^2] above -g the floor presses on
  const bool mirrored = GENERATE(true, false);
  const Leaf ball =
      ball_over([=](double t) { return 0.5 * a * std::pow(std::max(t - 1.0, 0.0), 2); },
                [=](double t) { return a * std::max(t - 1.0, 0.0); }, 0.5, mirrored);
  const auto start = ball.create_context().with_continuous_state(vec({0.0, 0.0}));
  const auto results =
      simulate(ball, start, {0.0, 3.0}, {.rtol = 1e-8, .atol = 1e-10, .ode_solver_method = method});
  INFO(method << ", a = " << a << ", mirrored " << mirrored);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(count(results.events, EventKind::zeno_release) == 0);
  // The reset map puts the ball on the floor, at its speed: a few roundings of 2 a.
  CHECK(std::abs(results.context.continuous_state()[0] - 2.0 * a) <= 1e-9);
  CHECK(std::abs(results.context.continuous_state()[1] - 2.0 * a) <= 1e-9);
}

TEST_CASE("4.5 a ball does not hover where its floor moves away, whatever its reset map says of it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double speed = GENERATE(-2.0, -0.3, 1.3);
  const bool mirrored = GENERATE(true, false);
  const Leaf ball =
      ball_over([=](double t) { return speed * t; }, [=](double) { return speed; }, 0.4, mirrored);
  const auto start = ball.create_context().with_continuous_state(vec({0.3, 0.0}));
  const auto results =
      simulate(ball, start, {0.0, 3.0}, {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = method});
  INFO(method << ", speed " << speed << ", mirrored " << mirrored);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(count(results.events, EventKind::zeno_release) == 0);
  // The place is a fixed point of both maps, and the mirror's is the surface itself: a few roundings.
  CHECK(std::abs(results.context.continuous_state()[0] - 3.0 * speed) <= 1e-14);
  CHECK(std::abs(results.context.continuous_state()[1] - speed) <= 1e-14);
}

TEST_CASE("4.5 a guard that the time takes on through a block at rest is not kept at zero",
          "[semantics]") {
  // g = t - 1 + x / 5. The resets x+ = x / 2 set g back by less and less, until t = 1 at x = 0. From
  // then on the time alone moves g, and no reset can hold it: x' = 1 / 10 goes on from there.
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At&) { return 0.1; }});
    l.declare_zero_crossing(
        {.name = "pass",
         .guard = [](const At& at) { return at.time - 1.0 + 0.2 * at.x[0]; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({0.5 * at.x[0]}); },
         .direction = Direction::negative_then_non_negative});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0},
                                {.rtol = 1e-8, .atol = 1e-10, .ode_solver_method = method});
  INFO(method);
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(count(results.events, EventKind::zeno_release) == 1);
  // It rests within the Zeno tolerance of 1e-6 s on either side of t = 1, at a rate of 0.1.
  CHECK(std::abs(results.context.continuous_state()[0] - 0.2) <= 2e-7 + 1e-8);
}
