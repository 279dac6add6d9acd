// Event times of the bouncing leaf ball against its closed form: thirty contacts, by every method.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Largest error of the contact times to t = 26 s.
double worst_contact(Method method) {
  const BallScene scene = leaf({.e = 0.9});
  const auto results = simulate(*scene.system, scene.context(10.0, 0.0), {0.0, 26.0},
                                {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method});
  const BallExact exact{9.81, 0.9, 10.0};
  const auto times = results.events.times("bounce");
  REQUIRE(times.size() == 30);
  double worst = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i)
    worst = std::max(worst, std::abs(times[i] - exact.contact(static_cast<int>(i) + 1)));
  return worst;
}

}  // namespace

TEST_CASE("thirty contacts of the ball are where the closed form says", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // A relative velocity error r of a flight moves all later contacts by r times what is left of 26
  // s. One-step methods are exact for a parabola but for rounding: thirty flights, a few eps each,
  // and what DOP853's weights, up to 44, make of that, 5 eps, and the 2 eps of the offset to which
  // a root is located: 26 s * 30 * 7 eps = 1.2e-12 s.
  double allowed = 1.2e-12;
  // Adams is exact once its order is 2; before that a flight's error is its tolerance, 1e-12 m at
  // the floor, divided by a speed above 0.6 m/s, and thirty of them: 30 * 1e-12 / 0.6 = 5e-11 s.
  if (method == Method::adams) allowed = 1e-10;
  // BDF starts with order 1 too and rises slowly: a flight's error is rtol; 26 s * 30 * 1e-10.
  if (method == Method::bdf) allowed = 8e-8;
  const double worst = worst_contact(method);
  INFO("worst " << worst << " s");
  CHECK(worst < allowed);
}
