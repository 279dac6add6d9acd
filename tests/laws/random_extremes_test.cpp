// No ball falls through its floor, gains energy or hangs, however few digits are left: floors at up
// to 1e12 m, starts up to 1e9 s, gravity over ten decades. Drawn at random, the same ones each
// time.
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

void none_falls(Method method, bool of_blocks, double farthest, double latest) {
  std::mt19937 random{20260306};
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int n = 0; n < 300; ++n) {
    const double g = std::pow(10.0, real(-5.0, 5.0)), e = n % 5 == 0 ? 0.0 : real(0.0, 1.0);
    const double height = std::pow(10.0, real(-4.0, 4.0));
    const double floor = real(-1.0, 1.0) * std::pow(10.0, real(-3.0, 1.0)) * 0.1 * farthest;
    const double t1 = std::sqrt(2.0 * height / g);
    const double t0 = real(-1.0, 1.0) * std::pow(10.0, real(-3.0, 1.0)) * 0.1 * latest * t1;
    const double rtol = std::pow(10.0, real(-12.0, -4.0)), atol = rtol * height;
    const BallOptions options{.g = g, .e = e, .floor = floor};
    const BallScene scene = of_blocks ? blocks(Contact::comparator, options) : leaf(options);
    const double end = t0 + t1 * real(1.0, 30.0);
    const auto results = simulate(*scene.system, scene.context(floor + height, 0.0, t0), {t0, end},
                                  {.rtol = rtol,
                                   .atol = atol,
                                   .ode_solver_method = method,
                                   .max_major_steps = 100000,
                                   .zeno_tolerance = 1e-6 * t1,
                                   .throw_errors = false});
    INFO("scene " << n << ": " << method << ", g " << g << ", e " << e << ", height " << height
                  << ", floor " << floor << ", t0 " << t0 << ", rtol " << rtol << ": "
                  << results.message);
    CHECK(results.status == Status::reached_end);
    const auto& x = results.context.continuous_state();
    // A thousand steps at most, each a rounding of the floor's height, or with a multistep method
    // rtol (|floor| + height) + atol, all counting one way; and a location's 100 eps t at the
    // impact's speed.
    const double step = one_step(method) ? eps * (std::abs(floor) + height)
                                         : rtol * (std::abs(floor) + height) + atol;
    const double good = 1e3 * step + 200.0 * eps * std::max(std::abs(t0), std::abs(end)) * g * t1;
    CHECK(x[0] - floor >= -good);
    const double energy = g * (x[0] - floor) + 0.5 * x[1] * x[1];
    CHECK(energy <= g * height + 40.0 * g * good);  // contacts, each put on the floor anew
  }
}

}  // namespace

TEST_CASE("no ball as a leaf falls through its floor, with few digits left",
          "[laws][ball][random]") {
  none_falls(GENERATE(filter(one_step, from_range(methods))), false, 1e2, 1e6);
}

// What comes out on floors from 1e5 m on: some fall through, leaf and blocks, where a ball is at
// rest: its guard is within rounding of zero for longer than the engine looks ahead, has no side,
// and is not armed. From 1e8 m on as in ball_far_test.cpp.
TEST_CASE("no ball falls through its floor, with hardly a digit left",
          "[.engine][laws][ball][random]") {
  none_falls(GENERATE(from_range(methods)), GENERATE(false, true), 1e12, 1e9);
}
