// Semantics 3.6, 3.7, 3.10: writing is what counts; what a mode changes; when the solver restarts.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

Leaf with_reset(const ResetMap& reset) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "half", .guard = [](const At& at) { return at.x[0] - 0.5; }, .reset_map = reset});
  });
}

Results run(const System& system, Method method, double end = 1.0) {
  return simulate(system, system.create_context(), {0.0, end}, {.ode_solver_method = method});
}

}  // namespace

TEST_CASE("3.6 writing the value that was there is a reset: j counts it, the solver restarts",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto same =
      run(with_reset([](const At& at, Next& next) { next.set_continuous_state(at.x); }), method);
  REQUIRE(same.events.size() == 1);
  CHECK(same.events[0].jump == 1);
  CHECK(same.statistics.restarts == 1);
}

TEST_CASE("3.7 a guard without start_mode is seen in all modes; after it the mode is end_mode",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_default_mode(3);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "change", .guard = [](const At& at) { return at.x[0] - 0.5; }, .end_mode = -2});
    for (const double level : {0.25, 0.75}) {
      l.declare_zero_crossing({.name = text("any_", level),
                               .guard = [=](const At& at) { return at.x[0] - level; },
                               .reset_map = count_up});
    }
  });
  const auto results = run(leaf, method);
  CHECK(results.context.mode() == -2);
  CHECK(results.context.discrete_state()[0] == 2.0);
}

TEST_CASE("3.10 the solver is restarted once for each bounce, and for nothing else",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const BallScene scene = leaf({.e = 1.0});
  const auto results =
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 10.0}, {.ode_solver_method = method});
  CHECK(results.events.size() == 11);  // t1 = 0.4515 s, then every 0.903 s
  CHECK(results.statistics.restarts == 11);
}

TEST_CASE("3.10 a reset that writes discrete state which no derivative reads restarts nothing",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}),
                                .ode = [](const At&) { return 1.0; },
                                .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "half",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .reset_map = count_up});
  });
  const auto results = run(leaf, method);
  CHECK(results.events.size() == 1);
  CHECK(results.statistics.restarts == 0);
}

TEST_CASE("3.10 a change of a relation or of a mode that a derivative reads restarts the solver",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf by_mode("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.mode == 0 ? 1.0 : 3.0; }});
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "half",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .start_mode = 0,
                             .end_mode = 1});
  });
  const Leaf by_relation("leaf", [](Leaf& l) {
    const auto above =
        l.declare_relation({.name = "above", .guard = [](const At& at) { return at.x[0] - 0.5; }});
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [=](const At& at) {
                                  return at.relation(above) ? 3.0 : 1.0;
                                }});
  });
  for (const Leaf* leaf : {&by_mode, &by_relation}) {
    const auto results = run(*leaf, method);
    CHECK(results.statistics.restarts == 1);
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(2.0, 1e-9));
  }
}
