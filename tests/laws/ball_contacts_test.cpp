// Contact k of a dropped ball is at t1 + 2 t1 (e + ... + e^(k-1)), its speed after it e^k g t1.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// One edge or zero crossing per contact: the crossings of the relation are logged beside the
/// resets.
std::vector<double> contact_times(const BallScene& scene, const Results& results) {
  return results.events.times(scene.leaf ? "bounce" : "difference");
}

}  // namespace

TEST_CASE("contact k of a ball as a leaf comes when the closed form says", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.5, 0.9, 1.0);
  INFO("method " << method << ", e = " << e);
  const BallExact exact{9.81, e, 10.0};
  const BallScene scene = leaf({.e = e});
  const double end = exact.contact(6) + 0.1 * exact.speed(6) / 9.81;
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(*scene.system, scene.context(10.0, 0.0), {0.0, end},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  const auto times = contact_times(scene, results);
  REQUIRE(times.size() == 6);
  // A flight is a parabola, so a Runge-Kutta method is exact; the multistep methods err by their
  // tolerance in each of some 20 steps a flight. An error in the speed of contact k is carried on
  // as a time 2 dv/g in every later flight.
  const double tolerance = 6.0 * 6.0 * 20.0 * (rtol * 14.0 + atol) / 9.81;
  for (int k = 1; k <= 6; ++k) {
    CHECK_THAT(times[static_cast<std::size_t>(k - 1)], WithinAbs(exact.contact(k), tolerance));
  }
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const Event event = results.events[i];
    CHECK(event.before[0] <= 0.0);  // handed on beyond the floor or on it, never before
    CHECK_THAT(event.after[1], WithinAbs(exact.speed(static_cast<int>(i) + 1), 9.81 * tolerance));
  }
}

TEST_CASE("a ball from blocks bounces when its leaf does, whatever tells the contact",
          "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const Contact contact = GENERATE(from_range(contacts));
  const BallScene scene = blocks(contact, {.e = 0.9});
  INFO("method " << method << ", " << scene.form);
  const BallExact exact{9.81, 0.9, 10.0};
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(*scene.system, scene.context(10.0, 0.0), {0.0, 12.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  std::vector<double> times;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].block == "integrator_y") times.push_back(results.events[i].time);
  }
  REQUIRE(times.size() == 6);
  const double tolerance = 6.0 * 6.0 * 20.0 * (rtol * 14.0 + atol) / 9.81;
  for (int k = 1; k <= 6; ++k) {
    CHECK_THAT(times[static_cast<std::size_t>(k - 1)], WithinAbs(exact.contact(k), tolerance));
  }
}

TEST_CASE("the one-step method is exact on parabolas: contacts right to rounding", "[laws][ball]") {
  const BallExact exact{9.81, 0.9, 10.0};
  for (const BallScene& scene : all_forms({.e = 0.9})) {
    INFO(scene.form);
    const auto results = simulate(*scene.system, scene.context(10.0, 0.0), {0.0, 12.0},
                                  {.ode_solver_method = Method::dopri5});
    std::vector<double> times;
    for (std::size_t i = 0; i < results.events.size(); ++i) {
      const Event event = results.events[i];
      if (event.block == "ball" || event.block == "integrator_y") times.push_back(event.time);
    }
    REQUIRE(times.size() == 6);
    // Six flights; each adds a few roundings of heights up to 10 m and of times up to 12 s, divided
    // by a speed above 8 m/s, and 100 eps (|t| + |h|) of location: together below 6 * (200 + 100)
    // eps * 24 s.
    for (int k = 1; k <= 6; ++k) {
      CHECK_THAT(times[static_cast<std::size_t>(k - 1)],
                 WithinAbs(exact.contact(k), 6.0 * 300.0 * eps * 24.0));
    }
  }
}

TEST_CASE("with restitution 1 the energy stays over many bounces", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const BallScene scene = leaf({.e = 1.0});
  const double rtol = 1e-8, atol = 1e-10;
  const auto results = simulate(*scene.system, scene.context(10.0, 0.0), {0.0, 300.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  INFO("method " << method);
  CHECK(count(results.events, EventKind::zero_crossing) == 105);  // t1 = 1.4278 s, period 2.8557 s
  const double energy0 = 9.81 * 10.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    const double v = results.events[i].after[1];
    worst = std::max(worst, std::abs(0.5 * v * v - energy0));
  }
  // dE = v dv: 105 flights of at most 40 steps, each wrong by rtol |v| + atol at |v| <= 14 m/s.
  CHECK(worst <= 105.0 * 40.0 * 14.0 * (rtol * 14.0 + atol));
}
