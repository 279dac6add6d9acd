// Semantics 4.5: a ball on a table that goes up and down: it lifts off when the table falls away
// faster than gravity, lands, bounces and rests again.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 10.0, w = 20.0;         // [m/s^2], [rad/s]
constexpr double amplitude = 2 * g / w / w;  // the table's acceleration reaches 2 g

double table(double t) { return amplitude * std::sin(w * t); }
double table_speed(double t) { return amplitude * w * std::cos(w * t); }

/// Height over the table and speed relative to it: a frame that moves.
Leaf moving_frame(double e) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << at.x[1], -g + amplitude * w * w * std::sin(w * at.time);
         }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// The same in a frame that stands still.
Leaf fixed_frame(double e) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0, table_speed(0.0)}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -g; }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [](const At& at) { return at.x[0] - table(at.time); },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   const double speed = table_speed(at.time);
                                   next.set_continuous_state(
                                       {table(at.time), speed - e * (at.x[1] - speed)});
                                 },
                             .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("4.5 a ball lifts off a table at the moment it falls away faster than gravity",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool frame_moves = GENERATE(true, false);
  const double e = GENERATE(0.0, 0.2);
  INFO("method " << method << ", moving frame " << frame_moves << ", e " << e);
  const Leaf ball = frame_moves ? moving_frame(e) : fixed_frame(e);
  const double pi = std::acos(-1.0);
  const int rounds = 5;
  const auto results =
      simulate(ball, ball.create_context(), {0.0, 2.0 * pi * rounds / w},
               {.rtol = 1e-10, .atol = 1e-13, .ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::reached_end);
  const auto off = results.events.times("bounce", EventKind::zeno_release);
  REQUIRE(off.size() == rounds);
  // 2 g sin(w t) = g at w t = pi / 6, in each round: it lands at 5.18 rad and rests before the
  // next.
  for (int k = 0; k < rounds; ++k) {
    CHECK_THAT(off[static_cast<std::size_t>(k)], WithinAbs((pi / 6.0 + 2.0 * pi * k) / w, 1e-6));
  }
  const double height = results.context.continuous_state()[0];
  CHECK_THAT(height - (frame_moves ? 0.0 : table(results.context.time())), WithinAbs(0.0, 1e-6));
  CHECK(results.statistics.events < 1000);
}
