// The looks that many monitors do not cost: they are located together.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 with n monitors that fire once each, as one vector or one by one.
Leaf ruler(Index n, bool vector) {
  return Leaf("ruler", [&](Leaf& l) {
    declare_ramp(l);
    const auto level = [n](Index i) {
      return (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    };
    if (vector) {
      l.declare_zero_crossing({.name = "level",
                               .guard =
                                   [=](const At& at, VectorRef out) {
                                     for (Index i = 0; i < n; ++i) out[i] = at.x[0] - level(i);
                                   },
                               .size = n});
      return;
    }
    for (Index i = 0; i < n; ++i) {
      const double root = level(i);
      l.declare_zero_crossing(
          {.name = text("level_", i), .guard = [root](const At& at) { return at.x[0] - root; }});
    }
  });
}

}  // namespace

TEST_CASE("monitors that fire once each cost a number of looks that does not grow with them",
          "[absent]") {
  const auto method = GENERATE(from_range(methods));
  const bool vector = GENERATE(true, false);
  INFO("method " << method << (vector ? ", a vector" : ", single guards"));
  // A step has four pieces. A piece with eight crossings or more takes eleven looks inside it, and
  // again as many where it is halved; seven crossings one by one take ten looks each. Located one
  // by one, 2000 crossings take 14 000 looks.
  for (const Index n : {200, 2000}) {
    const Leaf leaf = ruler(n, vector);
    const Results results =
        simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    CHECK(static_cast<Index>(results.events.size()) == n);
    CHECK(results.statistics.guard_calls <= 4 * 70 * (results.statistics.steps + 1));
  }
}
