// Semantics 2.5: no ball falls through a floor, however its author wrote its guard and reset map.
#include <random>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// How a reset map says where the ball is: on the floor, where location left it, or above it.
enum class Height { floor, kept, mirrored };

constexpr double g = 10.0;

struct Drop {
  double e, floor, height, t0;
  Height style;
  Direction direction;
};

Leaf ball(const Drop& drop) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({drop.floor + drop.height, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [=](const At& at) { return at.x[0] - drop.floor; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   const double y = at.x[0], gap = std::abs(y - drop.floor);
                                   next.set_continuous_state(
                                       {drop.style == Height::floor      ? drop.floor
                                        : drop.style == Height::mirrored ? drop.floor + gap
                                                                         : y,
                                        -drop.e * at.x[1]});
                                 },
                             .direction = drop.direction});
  });
}

/// Three times the time to its Zeno point: it must be at rest on its floor. How far it is below.
void rests(const Drop& drop, Method method, double tolerance) {
  const double first = std::sqrt(2.0 * drop.height / g);
  const double end = drop.t0 + 3.0 * first * (1.0 + drop.e) / (1.0 - drop.e);
  const Leaf leaf = ball(drop);
  const auto results = simulate(leaf, leaf.create_context(drop.t0), {drop.t0, end},
                                {.rtol = tolerance,
                                 .atol = 1e-2 * tolerance,
                                 .ode_solver_method = method,
                                 .throw_errors = false});
  INFO(method << ", tolerance " << tolerance << ", e " << drop.e << ", floor " << drop.floor
              << ", height " << drop.height << ", t0 " << drop.t0 << ", style "
              << static_cast<int>(drop.style) << ", " << to_string(drop.direction) << ": "
              << to_string(results.status)
              << " at y - floor = " << results.context.continuous_state()[0] - drop.floor
              << ", v = " << results.context.continuous_state()[1]);
  CHECK(results.status == Status::reached_end);
  CHECK(count(results.events, EventKind::zeno_enter) >= 1);
  // On hold it stands where a reset put it: as far from the floor as the tolerance leaves the
  // height uncertain, which is all that a reset that keeps the height can do.
  CHECK(std::abs(results.context.continuous_state()[0] - drop.floor) <
        std::max(1e-9, tolerance) + 100.0 * eps * std::abs(drop.floor));
  // Flights that rise less than 1e4 atol are not seen by a multistep method.
  CHECK(std::abs(results.context.continuous_state()[1]) < std::sqrt(2.0 * g * 1e2 * tolerance));
}

void all_rest(Direction direction, Height style) {
  std::mt19937 random(7);
  const auto one_of = [&](auto values) { return values[random() % values.size()]; };
  for (int i = 0; i < 1000; ++i) {
    const double height =
        one_of(std::array{1e-3, 0.1, 1.0}) * (1.0 + 1e-3 * static_cast<double>(random() % 1000));
    const Drop drop{one_of(std::array{0.0, 0.3, 0.9}),
                    one_of(std::array{0.0, 0.3, -7.0, 1e3}),
                    height,
                    one_of(std::array{0.0, -3.0, 1e4}),
                    style,
                    direction};
    // Tolerances that see the flight: rtol |floor| is below a hundredth of a millimetre.
    rests(drop, one_of(methods), 1e-9 * one_of(std::array{1.0, 10.0}));
  }
}

}  // namespace

TEST_CASE("2.5 no ball falls through a floor: falling guard, any way to write the reset",
          "[semantics]") {
  all_rest(Direction::positive_then_non_positive,
           GENERATE(Height::floor, Height::kept, Height::mirrored));
}

TEST_CASE("2.5 no ball falls through a floor: default direction, any way to write the reset",
          "[semantics]") {
  all_rest(Direction::crosses_zero, GENERATE(Height::floor, Height::kept, Height::mirrored));
}

TEST_CASE("2.5 a ball that is located exactly on its floor rests there", "[semantics]") {
  // With dopri5 the guard is exactly 0 at the first contact, and the reset puts it at exactly 0.
  const double height = 0.0005305162348562786, end = -3.0 + 0.026102952987114719;
  const Leaf leaf = ball({0.0, 1000.0, height, -3.0, Height::floor, Direction::crosses_zero});
  const auto results = simulate(leaf, leaf.create_context(-3.0), {-3.0, end},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = Method::dopri5});
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(results.events.times("bounce").size() == 1);
  CHECK(results.context.continuous_state() == vec({1000.0, 0.0}));
}
