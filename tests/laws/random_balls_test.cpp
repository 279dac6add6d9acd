// No ball falls through a floor, at any tolerance, at any restitution: scenes drawn at random, the
// same ones each time.
#include <random>

#include "support/balls.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Draw {
  std::mt19937 random{20240229};
  double uniform(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  template <class List>
  const auto& any(const List& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random)];
  }
};

}  // namespace

TEST_CASE("no ball of 500 falls through its floor, gains energy or takes long",
          "[laws][ball][random]") {
  Draw draw;
  for (int n = 0; n < 500; ++n) {
    const double e = draw.chance(0.2) ? 0.0 : draw.chance(0.1) ? 1.0 : draw.uniform(0.0, 1.0);
    const double height = draw.power(-6.0, 2.0),
                 v = draw.chance(0.5) ? 0.0 : draw.uniform(-5.0, 5.0);
    const double floor = draw.chance(0.3) ? 0.0 : draw.uniform(-0.5, 0.5) * draw.power(-2.0, 2.0);
    const double rtol = draw.power(-11.0, -2.0), atol = rtol * draw.power(-3.0, 0.0);
    const double t0 = draw.chance(0.5) ? 0.0 : draw.uniform(-500.0, 500.0),
                 span = draw.uniform(0.5, 5.0);
    const Method method = draw.any(methods);
    const auto forms = all_forms({.e = e, .floor = floor});
    const BallScene& scene = draw.any(forms);
    INFO("scene " << n << ": " << scene.form << ", " << method << ", e " << e << ", height "
                  << height << ", v " << v << ", floor " << floor << ", rtol " << rtol << ", atol "
                  << atol << ", t0 " << t0 << ", span " << span);
    const auto results =
        simulate(*scene.system, scene.context(floor + height, v, t0), {t0, t0 + span},
                 {.rtol = rtol,
                  .atol = atol,
                  .ode_solver_method = method,
                  .max_major_steps = 100000,
                  .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    const double above = results.context.continuous_state()[0] - floor,
                 speed = results.context.continuous_state()[1];
    const double before = 9.81 * height + 0.5 * v * v, after = 9.81 * above + 0.5 * speed * speed;
    // A state is wrong by its tolerance in each of the steps, some tens of thousands at worst.
    CHECK(above >= -1e-6 - 1e4 * (rtol * (std::abs(floor) + height) + atol));
    CHECK(after <= before + 1e-6 + 2e4 * (rtol * (before + 9.81 * std::abs(floor) + 1.0) + atol));
  }
}
