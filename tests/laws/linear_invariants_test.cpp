// Linear invariants of a right-hand side: a sum of states whose derivatives add up to zero.
#include "saltus/models/e5.hpp"
#include "support/run.hpp"

using namespace saltus;

TEST_CASE("radau keeps a linear invariant to the rounding of the states", "[radau]") {
  // y2 - y3 - y4 of E5 decides its end, where all three are 1e12 times as small as in between.
  Scene scene = models::e5();
  const double rtol = GENERATE(1e-6, 1e-8, 1e-9, 1e-10, 1e-11);
  scene.options.atol = 1e-17 * rtol;
  scene.options.rtol = rtol;
  scene.options.ode_solver_method = Method::radau;
  const auto y = simulate(scene).context.continuous_state();
  // A step rounds y2 and y4 once, near 1.4e-10, where doubles are 2.6e-26 apart: with the standard
  // deviation 2.6e-26 / sqrt(12). Some 60 steps are taken while they are so large. Three standard
  // deviations of the sum are 3 sqrt(120) 7.5e-27.
  CHECK(std::abs(y[1] - y[2] - y[3]) < 2.5e-25);
}
