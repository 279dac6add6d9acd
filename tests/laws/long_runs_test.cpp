// 1e8 s at a stretch: 1e5 s between events, a tick every 1/3 s beside events of its own, a clock
// that loses nothing.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a thousand events 1e5 s apart are where they belong after 1e8 s", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l, 1e-5);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0] - 1.0}); }});
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1e8 + 5e4}, {.ode_solver_method = method});
    std::vector<double> expected;
    for (int k = 1; k <= 1000; ++k) expected.push_back(1e5 * k);
    // The reset keeps what a location overshot; what adds up is the rounding of x, ten steps of eps
    // each a period, over the slope 1e-5 / s: and each location's 100 eps (t + h).
    const double tolerance = 1000.0 * 10.0 * eps * 1e5 + 200.0 * eps * 1e8;
    within(text("1e8 s, ", form.name), method, worst(firing_times(results.events), expected),
           tolerance);
  }
}

TEST_CASE(
    "a guard that fires between thousands of ticks of 1/3 s fires on time, and no tick is lost",
    "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
         .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, 1.0 / 3.0);
    l.declare_zero_crossing({.name = "down",
                             .guard = [](const At& at) { return at.x[0]; },
                             .direction = Direction::positive_then_non_positive});
  });
  const double rtol = 1e-9, atol = 1e-11, end = 1000.0, pi = std::acos(-1.0);
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, end},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    CHECK(results.context.discrete_state()[0] == 3001.0);
    std::vector<double> expected;
    for (int k = 0; pi * (2 * k + 1) <= end; ++k) expected.push_back(pi * (2 * k + 1));
    // Ten local errors (BDF: a hundred) for each of a thousand seconds of an oscillator.
    within(text("ticks and crossings ", form.name), method,
           worst(results.events.times("down"), expected), allowed(method, rtol, atol, 1.0, end));
  }
}

TEST_CASE("ticks of two blocks that coincide now and then do both, at one time", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto counter = [](std::string name, double period) {
    return make_leaf(std::move(name), [=](Leaf& l) {
      declare_ramp(l);
      l.declare_discrete_state(vec({0.0}));
      l.declare_periodic_update(count_up, period, 0.0, "tick");
    });
  };
  DiagramBuilder builder;
  builder.add(counter("thirds", 1.0 / 3.0)), builder.add(counter("sevenths", 1.0 / 7.0));
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 100.0}, {.ode_solver_method = method});
  CHECK(results.context.discrete_state() == vec({301.0, 701.0}));
  // 301 + 701 ticks, of which 101 are at the whole seconds: one instant, one time, one jump.
  CHECK(results.statistics.instants <= 301 + 701 - 101 + 1);
  CHECK(results.events[results.events.size() - 1].jump == 301 + 701 - 101);
}

TEST_CASE("ticks are counted from their offset, wherever a run begins", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto ticks = [&](double period, double offset, double t0, double end) {
    const auto leaf = make_leaf("counter", [=](Leaf& l) {
      declare_ramp(l);
      l.declare_discrete_state(vec({0.0}));
      l.declare_periodic_update(count_up, period, offset);
    });
    const auto results =
        simulate(*leaf, leaf->create_context(t0), {t0, end}, {.ode_solver_method = method});
    return results.context.discrete_state()[0];
  };
  INFO("method " << method);
  CHECK(ticks(1.0 / 3.0, 0.0, 1e8, 1e8 + 1000.0) == 3001.0);  // at both ends
  CHECK(ticks(0.1, 0.0, 1e6, 1e6 + 100.0) == 1001.0);
  CHECK(ticks(0.5, -0.25, 0.0, 10.0) == 20.0);  // 0.25, 0.75, ..., 9.75
  CHECK(ticks(0.5, 0.25, -5.0, 1.0) == 2.0);    // none before the offset
  CHECK(ticks(7.0, 3.0, 3.0, 3.0) == 1.0);      // a run of no length, at a tick
}
