// Location: pairs of roots, roots very close together, the earliest first, the state on the firing
// side.
#include "saltus/solver/detail/guard_search.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = 1 with a counted guard at each of `roots`; the guards are declared in that order.
Leaf ruler(const std::vector<double>& roots, double scale = 1.0) {
  return Leaf("ruler", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const double root = roots[i];
      l.declare_zero_crossing({.name = text("at_", i),
                               .guard = [=](const At& at) { return scale * (at.x[0] - root); },
                               .reset_map = count_up});
    }
  });
}

Results run(const Leaf& leaf, Method method, SimulatorOptions options = {}) {
  options.ode_solver_method = method;
  return simulate(leaf, leaf.create_context(), {0.0, 1.0}, options);
}

}  // namespace

TEST_CASE("two guards 0, 1e-13 and 1e-9 apart fire both, the earlier one first", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  const double gap = GENERATE(0.0, 1e-13, 1e-9, 1e-3);
  INFO("method " << method << ", gap " << gap);
  const auto results = run(ruler({0.5 + gap, 0.5}), method);  // the later one is declared first
  REQUIRE(results.events.size() == 2);
  CHECK(results.context.discrete_state()[0] == 2.0);
  CHECK(results.events[0].time <= results.events[1].time);
  if (gap >= 1e-9) {
    CHECK(results.events[0].name == "at_1");
    CHECK(results.events[1].name == "at_0");
    CHECK_THAT(results.events[1].time - results.events[0].time, WithinAbs(gap, 1e-12));
  } else if (gap == 0.0) {
    CHECK(results.events[0].time == results.events[1].time);
    CHECK(results.events[0].jump == results.events[1].jump);  // one pass, declaration order
    CHECK(results.events[0].name == "at_0");
  }
}

TEST_CASE("twenty guards in one step fire in the order of their roots", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  std::vector<double> roots;
  for (int i = 0; i < 20; ++i) roots.push_back(0.01 + 0.9 * std::fmod(0.618 * (i + 1), 1.0));
  const auto results = run(ruler(roots), method);
  std::ranges::sort(roots);
  REQUIRE(results.events.size() == 20);
  for (std::size_t i = 0; i < 20; ++i)
    CHECK_THAT(results.events[i].time, WithinAbs(roots[i], 1e-12));
}

TEST_CASE("the state handed on is at the root or beyond it, never before", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  const double scale = GENERATE(1.0, -1.0, 1e-30, 1e30);
  INFO("method " << method << ", scale " << scale);
  for (const double root : {0.1, 0.3, 1.0 / 3.0, 0.537, 0.7, 0.9}) {
    const auto results = run(ruler({root}, scale), method);
    REQUIRE(results.events.size() == 1);
    CHECK(results.events[0].before[0] >= root);
    // 100 eps (|t| + |h|) on an interpolant that is exact for a straight line but
    // for rounding.
    CHECK_THAT(results.events[0].time, WithinAbs(root, 100.0 * eps * 2.0));
    CHECK(results.events[0].direction == (scale > 0.0 ? 1 : -1));
  }
}

TEST_CASE("a pair of roots in one step is found at interior points, and missed without them",
          "[locate]") {
  const Leaf leaf("dip", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "dip",
         .guard = [](const At& at) { return (at.x[0] - 0.45) * (at.x[0] - 0.8); },
         .reset_map = count_up});
  });
  CHECK(run(leaf, Method::dopri5).events.size() == 2);
  CHECK(run(leaf, Method::dopri5, {.event_scan_points = 20}).events.size() == 2);
  // x' = 1: the first step is 1e-6 or so, each next one tenfold; the last spans the dip.
  CHECK(run(leaf, Method::dopri5, {.event_scan_points = 0}).events.empty());
}

TEST_CASE("a dip in the first piece after a restart is found by the look behind it", "[locate]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  const double bottom = GENERATE(0.02, 0.05, 0.1, 0.12);
  INFO("method " << method << ", bottom " << bottom);
  // One step of 1 s; the first of its points is at 1/5 (dopri5) or 1/8 (dop853).
  const Leaf leaf("dip", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "dip",
         .guard = [=](const At& at) { return std::pow(at.x[0] - bottom, 2.0) - 1e-6; },
         .reset_map = count_up});
  });
  const Results results = run(leaf, method, {.first_step = 1.0});
  REQUIRE(results.events.size() == 2);
  CHECK_THAT(results.events[0].time, WithinAbs(bottom - 1e-3, 1e-12));
  CHECK_THAT(results.events[1].time, WithinAbs(bottom + 1e-3, 1e-12));
}

TEST_CASE("by default a step has as many points as the degree of its interpolant", "[locate]") {
  // A step of 1 s in which the guard comes close to zero: a look at the end, then one at each
  // point.
  const bool called = GENERATE(true, false);
  const Leaf leaf("near", [=](Leaf& l) {
    declare_ramp(l);
    ZeroCrossing near{.name = "near"};
    if (called)
      near.guard = [](const At& at) { return 1.0 + at.x[0] * (at.x[0] - 1.0); };
    else
      near.formula = Formula([](const auto& at) { return 1.0 + at.x(0) * (at.x(0) - 1.0); });
    l.declare_zero_crossing(near);
  });
  const auto looks = [&](Method method, std::optional<int> points) {
    return run(leaf, method, {.first_step = 1.0, .event_scan_points = points})
        .statistics.guard_calls;
  };
  for (const auto& [method, degree] : {std::pair{Method::dopri5, 4}, {Method::dop853, 7}}) {
    INFO("method " << method << (called ? ", called" : ""));
    CHECK(looks(method, {}) == looks(method, degree));
    // The first step of a run has four more, from which the distance of the looks is chosen. A called guard is
    // asked at one whether it follows the time, and at two whether it bends along a state that moves on a
    // line. This one does, so that one more look chooses the distance.
    CHECK(looks(method, degree) == looks(method, 0) + degree + 4 + (called ? 4 : 0));
  }
}

TEST_CASE("a guard may be at zero at a stop where it is far nearer to zero than it moved",
          "[locate]") {
  Guard guard;
  guard.set(Phase::armed, -1, 0.0);
  for (const double move : {1.0, -1.0, 1e-200, 1e200}) {
    CHECK(is_beside_stop(guard, 0.0, move));
    CHECK(is_beside_stop(guard, 1e-5 * move, move));
    CHECK_FALSE(is_beside_stop(guard, 1e-3 * move, move));
  }
  guard.jumps = true;  // its value does not say how far its zero is
  CHECK(is_beside_stop(guard, 1.0, 0.0));
  guard.set(Phase::waiting, -1, 0.0);
  CHECK_FALSE(is_beside_stop(guard, 0.0, 1.0));
}

TEST_CASE("looks inside steps that need none come after 7 of them, then 15, 31 and 63",
          "[locate]") {
  const Leaf leaf("far", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "far", .guard = [](const At& at) { return at.x[0] + 1e6; }});
  });
  const auto looks_inside = [&](int steps) {
    SimulatorOptions options{.first_step = 1.0 / steps, .event_scan_points = 5};
    options.max_minor_step_size = 1.0 / steps;
    const Statistics all = run(leaf, Method::dopri5, options).statistics;
    return static_cast<double>(all.guard_calls - all.steps) / 5.0;
  };
  // Those at 0, 8, 24 and 56: a trend is seen early, and costs little.
  CHECK(looks_inside(60) >= 3.0);
  CHECK(looks_inside(60) < 6.0);
  // One in 64 in the long run: no pair of crossings stays unseen for more than some steps.
  CHECK(looks_inside(6400) > 60.0);
  CHECK(looks_inside(6400) < 200.0);
}

TEST_CASE("a guard with a steep and one with a flat root are located alike", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("curves", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "steep",
                             .guard = [](const At& at) { return std::tanh(1e8 * (at.x[0] - 0.3)); },
                             .reset_map = count_up});
    l.declare_zero_crossing({.name = "flat",
                             .guard = [](const At& at) { return std::pow(at.x[0] - 0.6, 5.0); },
                             .reset_map = count_up});
    l.declare_zero_crossing({.name = "jump",
                             .guard = [](const At& at) { return at.x[0] < 0.9 ? -1e300 : 1e-300; },
                             .reset_map = count_up});
  });
  const auto results = run(leaf, method);
  REQUIRE(results.events.size() == 3);
  CHECK_THAT(results.events[0].time, WithinAbs(0.3, 1e-12));
  CHECK_THAT(results.events[1].time, WithinAbs(0.6, 1e-12));
  CHECK_THAT(results.events[2].time, WithinAbs(0.9, 1e-12));
}

TEST_CASE("late in a long run events are located as exactly as time can say", "[locate]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const double t0 = 1e6;
  const Leaf leaf = ruler({0.537});
  const auto results =
      simulate(leaf, leaf.create_context(t0), {t0, t0 + 1.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 1);
  CHECK_THAT(results.events[0].time, WithinAbs(t0 + 0.537, 100.0 * eps * (t0 + 1.0)));
  CHECK(results.events[0].before[0] >= 0.537);
}
