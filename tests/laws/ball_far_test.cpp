// A ball late in time, high above zero, or of a size that the default tolerances were not made for:
// fewer digits, the same laws. It comes to rest, it does not fall through, nothing hangs.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

/// Whether what a run leaves is a ball at rest on `floor`, to `height` and the speed such a height
/// gives.
void rests(const std::string& scene, Method method, const Results& results, double floor,
           double height, double gravity = g) {
  INFO(scene << ", method " << method << ": " << results.message);
  CHECK(results.status == Status::reached_end);
  const auto& x = results.context.continuous_state();
  within(scene + ", y", method, std::abs(x[0] - floor), height);
  within(scene + ", v", method, std::abs(x[1]), 2.0 * std::sqrt(2.0 * gravity * height));
}

void late_in_time(Method method, double t0) {
  const BallExact exact{g, 0.5, 1.0};
  const double rtol = 1e-9, atol = 1e-11;
  for (const BallScene& scene :
       {leaf({.g = g, .e = 0.5}), blocks(Contact::comparator, {.g = g, .e = 0.5})}) {
    const auto results =
        simulate(*scene.system, scene.context(1.0, 0.0, t0), {t0, t0 + 3.0},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
    // A contact is early or late by a location, 100 eps t; the ball is that much g t too low or
    // fast; flights shorter than that drown.
    const double blind = 200.0 * eps * std::abs(t0);
    rests(text("ball from t0=", t0, " ", scene.form), method, results, 0.0,
          4.5 * blind + 40.0 * (rtol + atol));
    auto times = contact_times(results.events);
    times.resize(std::min<std::size_t>(times.size(), 4));
    for (double& t : times) t -= t0;
    std::vector<double> expected;
    for (int k = 1; k <= 4; ++k) expected.push_back(exact.contact(k));
    const double made = one_step(method) ? 0.0 : 40.0 * (rtol * 4.5 + atol) / g;
    within(text("contacts from t0=", t0, " ", scene.form), method, worst(times, expected),
           4.0 * 4.0 * (made + blind));
  }
}

void far_from_zero(Method method, double floor, double e, bool of_blocks) {
  const BallOptions options{.g = g, .e = e, .floor = floor};
  const BallScene scene = of_blocks ? blocks(Contact::comparator, options) : leaf(options);
  const double rtol = 1e-13, atol = 1e-10;
  const auto results =
      simulate(*scene.system, scene.context(floor + 1.0, 0.0), {0.0, 15.0},
               {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
  // Heights are told apart by eps |floor|, and to rtol |floor| + atol a step.
  rests(text("ball on a floor at ", floor, " e=", e, " ", scene.form), method, results, floor,
        8.0 * eps * std::abs(floor) + 40.0 * (rtol * std::abs(floor) + atol));
}

void of_any_size(Method method, double y0, double gravity) {
  for (const double e : {0.0, 0.5, 0.9}) {
    const BallExact exact{gravity, e, y0};
    for (const BallScene& scene :
         {leaf({.g = gravity, .e = e}), blocks(Contact::comparator, {.g = gravity, .e = e})}) {
      INFO("y0 " << y0 << ", g " << gravity << ", e " << e);
      const auto results =
          simulate(*scene.system, scene.context(y0, 0.0), {0.0, 2.0 * exact.rest()},
                   {.ode_solver_method = method, .throw_errors = false});
      // Flights lower than the errors of a flight, 40 steps of rtol y0 + atol, cannot be seen; nor
      // can such as are shorter than the Zeno tolerance, or than 64 roundings of the time.
      const double blind = std::max(1e-6, 64.0 * eps * 2.0 * exact.rest());
      rests(text("default options ", scene.form), method, results, 0.0,
            40.0 * (1e-6 * y0 + 1e-8) + gravity * blind * blind, gravity);
    }
  }
}

}  // namespace

TEST_CASE("late in time a ball bounces to the rounding of the time, by every method",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  late_in_time(method, GENERATE(-1e6, 1e6, 1e8));
}

TEST_CASE("far above zero a ball bounces on its floor and comes to rest there",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double floor = GENERATE(1e3, -1e6, 1e9), e = GENERATE(0.0, 0.5, 0.9);
  far_from_zero(method, floor, e, false);
}

// What comes out at 1e8 m and above: it falls through its floor by a kilometre. A contact is seen
// in the rounding of y - floor while the ball rises, and turns it downward.
TEST_CASE("far above zero a ball of blocks bounces on its floor and comes to rest there",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double floor = GENERATE(1e3, -1e6, 1e8, 1e9), e = GENERATE(0.0, 0.5, 0.9);
  far_from_zero(method, floor, e, true);
}

TEST_CASE("with the default options a ball of any size rests in the end", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double y0 = GENERATE(1e-9, 1e-3, 1.0, 1e3), gravity = GENERATE(1e-6, 9.81, 1e6);
  of_any_size(method, y0, gravity);
}

TEST_CASE("with the default options a ball from a million kilometres rests in the end",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  of_any_size(method, 1e9, GENERATE(1e-6, 9.81, 1e6));
}
