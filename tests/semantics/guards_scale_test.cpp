// Semantics 2.9a: the size of a guard does not matter, nor what lies beyond an event.
#include "support/watcher.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

TEST_CASE("2.9a a guard scaled to 1e-200 or 1e200 fires at the same time", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double scale = GENERATE(1e-200, 1e-300, 1e200, 1.0);
  INFO("method " << method << ", scale " << scale);
  const auto found =
      hits(watcher([=](const At& at) { return scale * (at.x[0] - 0.537); }), 1.0, method);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(0.537, 1e-9));
}

TEST_CASE("2.9a a slope that vanishes at the root does not hide it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto found =
      hits(watcher([](const At& at) { return std::pow(at.x[0] - 0.5, 3.0); }), 1.0, method);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(0.5, 1e-9));
}

TEST_CASE("2.9a a bad value behind an event is not seen: the step is shortened", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // Torricelli: the tank is empty at t = 1, and sqrt(h) is NaN beyond.
  const Leaf tank("tank", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  return at.mode == 0 ? -2.0 * std::sqrt(at.x[0]) : 0.0;
                                }});
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "empty",
                             .guard = [](const At& at) { return at.x[0] - 1e-6; },
                             .start_mode = 0,
                             .end_mode = 1});
  });
  const auto results = simulate(tank, tank.create_context(), {0.0, 2.0},
                                {.ode_solver_method = method, .throw_errors = false});
  CHECK(results.message == "");
  REQUIRE(results.events.size() == 1);
  CHECK(std::abs(results.events[0].time - (1.0 - 1e-3)) < 1e-4);
}
