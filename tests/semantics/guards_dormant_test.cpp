// Semantics 2.6: a guard that is zero for a while fires on reaching zero at most; nothing is
// printed.
#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = 1; the guard is 0 for 1 <= x <= 2, and has slopes -1 before it and `after` behind it.
Leaf plateau(double after, bool monitor) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard =
                                 [=](const At& at) {
                                   return std::max(1.0 - at.x[0], 0.0) +
                                          after * std::max(at.x[0] - 2.0, 0.0);
                                 },
                             .reset_map = monitor ? ResetMap() : ResetMap(count_up),
                             .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("2.6 a plateau of zeros is one firing, on reaching it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double after = GENERATE(1.0, 0.0);
  const bool monitor = GENERATE(false, true);
  INFO("method " << method << ", left with slope " << after << ", monitor " << monitor);
  const Leaf leaf = plateau(after, monitor);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0},
                                {.ode_solver_method = method, .max_minor_step_size = 0.1});
  const auto found = results.events.times("hit");
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(1.0, 1e-9));
}

TEST_CASE("2.6 a plateau at the start fires nothing, nor does leaving it to the armed side",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = plateau(1.0, false);
  const auto results =
      simulate(leaf, leaf.create_context().with_continuous_state({1.5}), {0.0, 3.0},
               {.ode_solver_method = method, .max_minor_step_size = 0.1});
  CHECK(results.events.empty());
}

TEST_CASE("2.6 no warning of a solver about a guard at zero reaches the terminal", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = plateau(1.0, false);
  const Leaf flat("flat", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.guard = [](const At&) { return 0.0; }});
  });
  CHECK(printed_by([&] {
          simulate(leaf, leaf.create_context(), {0.0, 3.0}, {.ode_solver_method = method});
          simulate(flat, flat.create_context(), {0.0, 3.0}, {.ode_solver_method = method});
        }) == "");
}
