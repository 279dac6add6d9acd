// Many guards: an event costs a bounded number of looks at all of them.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 from 0 to 1; guard i fires at (i + 1/2) / n, and restarts the solver. Counts how often a
/// guard is evaluated.
Leaf ruler(int n, std::int64_t& evaluations) {
  return Leaf("ruler", [&evaluations, n](Leaf& l) {
    declare_ramp(l);
    for (int i = 0; i < n; ++i) {
      const double level = (i + 0.5) / n;
      l.declare_zero_crossing(
          {.name = text("level_", i),
           .guard = [&evaluations, level](const At& at) { return ++evaluations, at.x[0] - level; },
           .reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); }});
    }
  });
}

}  // namespace

TEST_CASE("n guards with resets that fire once each are evaluated at most 16 n^2 times",
          "[laws][guards]") {
  // Each event looks at all guards at the end of the step, at the first of its points that is
  // behind the root, at four points before the root, at both ends of its bracket, and three times
  // in its instant: eleven. The others are the looks on the way to the root, at some of the guards.
  const int n = GENERATE(20, 60, 180);
  INFO("guards " << n);
  std::int64_t evaluations = 0;
  const Leaf leaf = ruler(n, evaluations);
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = Method::dopri5});
  CHECK(static_cast<int>(results.events.size()) == n);
  CHECK(evaluations <= 16 * n * n);
}
