// Semantics 2.5, 3.4: a guard that fired is at zero, and a later pass takes it back to where it came from.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// The guard x - level in words that round differently.
enum class View { same, scaled, expanded };

double seen(View view, double x, double level) {
  if (view == View::same) return x - level;
  return view == View::scaled ? 3.7 * (x - level) : 1.1 * x - 1.1 * level;
}

/// x' = rate. "count" counts in z0 where x is at its level; once it has, "pull" takes x back by `way`, a pass
/// later.
Leaf pulled(double rate, double level, double way, View view) {
  return Leaf("pulled", [=](Leaf& l) {
    declare_ramp(l, rate, level - rate);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "count",
                             .guard = [=](const At& at) { return seen(view, at.x[0], level); },
                             .reset_map = count_up});
    l.declare_zero_crossing(
        {.name = "pull",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [=](const At& at, Next& next) { next.set_continuous_state({at.x[0] - way}); },
         .direction = Direction::negative_then_non_negative});
  });
}

}  // namespace

TEST_CASE(
    "3.4 a guard of either direction that a later pass takes back from its root fires once there",
    "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const double rate : {1.0, -1.0, 0.1, 1.0 / 3.0, -7.3}) {
    for (const double level : {1.0, 0.3, 7.7, -2.2, 1e3}) {
      for (const View view : {View::same, View::scaled, View::expanded}) {
        const Leaf leaf = pulled(rate, level, 0.5 * rate, view);
        const Results results =
            simulate(leaf, leaf.create_context(), {0.0, 2.0},
                     {.rtol = 1e-9, .atol = 1e-12, .ode_solver_method = method});
        INFO("method " << method << ", rate " << rate << ", level " << level << ", view "
                       << static_cast<int>(view));
        const auto times = results.events.times("count");
        REQUIRE(times.size() == 2);
        // x is exact but for rounding.
        const double rounding = 1e-13 * (1.0 + std::abs(level / rate));
        CHECK_THAT(times[0], WithinAbs(1.0, rounding));
        CHECK_THAT(times[1], WithinAbs(1.5, rounding));
        CHECK(results.events.times("pull").size() == 1);
      }
    }
  }
}
