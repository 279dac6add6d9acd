// Not built. Semantics 4.5: a floor that rises continuously under a held ball carries it. The hold keeps the ball where
// it was, and the floor passes through it.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double g = 9.81;

std::shared_ptr<const System> step(double before, double after, double at) {
  return std::make_shared<Step>("floor", Step::Options{.start_value = before, .end_value = after, .step_time = at});
}

}  // namespace

TEST_CASE("a floor that rises steadily carries a resting ball with it", "[physics][ball][zeno]") {
  const auto* method = GENERATE(from_range(methods));
  const auto ramp = [] { return std::make_shared<Ramp>("floor", Ramp::Options{.slope = 0.5, .start_time = 1.0}); };
  const Scene scene = leaf_on({.g = g, .e = 0.0}, ramp());
  INFO("method " << method);
  const auto results = simulate(*scene.system, scene.context(0.0, 0.0), {0.0, 3.0},
                                {.ode_solver_method = method, .throw_errors = false});
  CHECK(results.message == "");
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(1.0, 1e-3));
}
