// Semantics 4.6: holding costs nothing.
#include "support/balls.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("4.6 holding costs nothing: the same steps for a second as for a million",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.g = 9.81})) {
    INFO(scene.form << ", method " << method);
    const auto results =
        simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 1e6}, {.ode_solver_method = method});
    CHECK(results.statistics.steps <= 30);  // a step may grow tenfold: 1e6 s from 1e-9 s takes 15
    CHECK(results.statistics.events <= 6);
  }
}
