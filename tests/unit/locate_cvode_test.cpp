// What CVODE's root-finding would do wrong if it were left alone: each trap, sprung. The same
// scenes by the one-step methods, as one contract holds for all.
#include "support/balls.hpp"
#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

Results run(const System& system, const Context& from, double t_end, Method method,
            SimulatorOptions options = {}) {
  options.ode_solver_method = method;
  return simulate(system, from, {0.0, t_end}, options);
}

}  // namespace

TEST_CASE("a guard that stays at zero behind its crossing fires once, and nothing is printed",
          "[locate][cvode]") {
  // Left alone, CVODE ends with CV_CLOSERR (-22), and warns of a guard that seems inactive.
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("plateau", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "reached",
                             .guard = [](const At& at) { return std::max(0.5 - at.x[0], 0.0); },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive});
    l.declare_zero_crossing(
        {.name = "always_zero", .guard = [](const At&) { return 0.0; }, .reset_map = count_up});
  });
  Results results;
  CHECK(printed_by([&] { results = run(leaf, leaf.create_context(), 1.0, method); }).empty());
  REQUIRE(results.events.size() == 1);
  CHECK(results.context.discrete_state()[0] == 1.0);
  CHECK_THAT(results.events[0].time, WithinAbs(0.5, 100.0 * eps * 1.5));
}

TEST_CASE("a guard at zero when a stretch begins is seen in its first step", "[locate][cvode]") {
  // Left alone, CVODE keeps a guard switched off that was zero at a restart, over the next one too,
  // and its order-1 interpolant of a flight falls from the start: the ball falls through.
  const auto method = GENERATE(Method::adams, Method::bdf);
  const double e = GENERATE(0.1, 0.5, 0.9), rtol = GENERATE(1e-4, 1e-7, 1e-10);
  INFO("method " << method << ", e " << e << ", rtol " << rtol);
  const BallScene scene = leaf({.e = e});
  const BallExact exact{9.81, e, 10.0};
  const auto results = run(*scene.system, scene.context(10.0, 0.0), exact.rest() + 1.0, method,
                           {.rtol = rtol, .atol = 0.01 * rtol});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.0, 1e-9));
  const auto times = results.events.times("bounce");
  for (std::size_t k = 1; k < times.size(); ++k) CHECK(times[k] > times[k - 1]);
  // Every flight higher than atol is seen: e^(2k) * 10 m > atol.
  const double seen = std::log(0.01 * rtol / 10.0) / std::log(e) / 2.0;
  CHECK(static_cast<double>(times.size()) >= std::min(std::floor(seen), 8.0));
}

TEST_CASE("guards whose product underflows or overflows are located like any other",
          "[locate][cvode]") {
  const auto method = GENERATE(from_range(methods));
  const double scale = GENERATE(1e-300, 1e-200, -1e-160, 1e160, 1e300);
  INFO("method " << method << ", scale " << scale);
  const Leaf leaf("scaled", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "at",
                             .guard = [=](const At& at) { return scale * (at.x[0] - 0.3); },
                             .reset_map = count_up});
  });
  const auto results = run(leaf, leaf.create_context(), 1.0, method);
  REQUIRE(results.events.size() == 1);
  CHECK_THAT(results.events[0].time, WithinAbs(0.3, 100.0 * eps * 1.3));
  CHECK(results.events[0].before[0] >= 0.3);
}

TEST_CASE("a located state is on the surface but for 100 eps (|t| + |h|), on a curved path too",
          "[locate][cvode]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-4, 1e-8, 1e-11);
  INFO("method " << method << ", rtol " << rtol);
  const Leaf leaf("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "third",
                             .guard = [](const At& at) { return at.x[0] - 0.3; },
                             .reset_map = count_up});
  });
  const auto results = run(leaf, leaf.create_context(), 30.0, method,
                           {.rtol = rtol, .atol = rtol, .max_minor_step_size = 1.0});
  REQUIRE(results.events.size() ==
          9);  // cos t = 0.3: 4.8 periods, two crossings each, the tenth at 30.15
  for (std::size_t i = 0; i < 9; ++i) {
    const Event event = results.events[i];
    const double missed = std::abs(event.before[0] - 0.3) / std::abs(event.before[1]);
    CHECK(missed <= 100.0 * eps * (event.time + 1.0));
  }
}

TEST_CASE("a guard that never fires costs one look at each end and interior point of a step",
          "[locate][cvode]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::adams, Method::bdf);
  const int points = GENERATE(0, 3);
  INFO("method " << method << ", points " << points);
  const Leaf leaf("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_zero_crossing(
        {.name = "far", .guard = [](const At& at) { return at.x[0] - 10.0; }, .terminal = true});
  });
  const auto results =
      run(leaf, leaf.create_context(), 100.0, method, {.event_scan_points = points});
  const Statistics& s = results.statistics;
  // CVODE looks at the end of a step once more, and where it starts; the engine where a run starts.
  const bool cvode = method == Method::adams || method == Method::bdf;
  CHECK(s.guard_calls <= s.steps * (points + (cvode ? 2 : 1)) + 10);
}
