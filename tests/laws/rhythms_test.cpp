// Series of events that are no Zeno point: equal gaps however short, growing gaps, gaps that shrink
// for a while.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a steady rhythm of nanoseconds or less goes on, and is no Zeno point", "[laws][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double gap = GENERATE(1e-6, 1e-9, 1e-15);
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 1.0 / gap);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0] - 1.0}); }});
  });
  for (const Form& form : forms(leaf)) {
    const int n = 3000;
    const auto results =
        simulate(*form.system, form.context(), {0.0, (n + 0.5) * gap},
                 {.ode_solver_method = method, .zeno_tolerance = 1e-5, .throw_errors = false});
    INFO(results.message);
    CHECK(results.status == Status::reached_end);
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
    std::vector<double> expected;
    for (int k = 1; k <= n; ++k) expected.push_back(k * gap);
    // What a location overshoots, 100 eps (t + h), is kept by the reset; each period rounds x ten
    // times and the time, up to n gaps, once: that adds up.
    within(text("rhythm of ", gap, " s, ", form.name), method,
           worst(firing_times(results.events), expected) / gap, n * (200.0 + 10.0 + n) * eps);
  }
}

TEST_CASE("a ball that gains at each bounce never comes to rest", "[laws][ball][zeno]") {
  const auto method = GENERATE(filter(one_step, from_range(methods)));
  const double e = GENERATE(1.01, 1.5);
  const double y0 = 1e-12, g = 9.81;  // the first flight: 9e-7 s, below the Zeno tolerance
  const BallExact exact{g, e, y0};
  const int n = e < 1.1 ? 1000 : 30;
  for (const BallScene& scene :
       {leaf({.g = g, .e = e}), blocks(Contact::comparator, {.g = g, .e = e})}) {
    const double end = 0.5 * (exact.contact(n) + exact.contact(n + 1));
    const auto results =
        simulate(*scene.system, scene.context(y0, 0.0), {0.0, end},
                 {.rtol = 1e-9, .atol = 1e-21, .ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::reached_end);
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
    const auto times = contact_times(results.events);
    REQUIRE(times.size() == static_cast<std::size_t>(n));
    double relative = 0.0;
    for (int k = 1; k <= n; ++k)
      relative = std::max(
          relative, std::abs(times[static_cast<std::size_t>(k - 1)] / exact.contact(k) - 1.0));
    // All times grow alike, and errors with them: n contacts of 200 eps t each.
    within(text("gaining ball e=", e, " ", scene.form), method, relative, 2.0 * n * 200.0 * eps);
  }
}

TEST_CASE("bounces that shrink for a while, and then are driven on, are no Zeno point",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  // Every reset keeps half of the speed, but is never below 1 m/s: gaps 0.4, 0.2, 0.2, ... s.
  const auto ball = make_leaf("ball", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 4.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -10.0; }});
    l.declare_zero_crossing({.name = "bounce",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state({0.0, std::max(1.0, -0.5 * at.x[1])});
                                 },
                             .direction = Direction::positive_then_non_positive});
  });
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : forms(ball)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 20.1},
                                  {.rtol = rtol,
                                   .atol = atol,
                                   .ode_solver_method = method,
                                   .zeno_tolerance = 1.0,
                                   .throw_errors = false});
    CHECK(count(results.events, EventKind::zeno_enter) == 0);
    std::vector<double> expected{0.8, 1.2};
    while (expected.back() + 0.2 < 20.1) expected.push_back(expected.back() + 0.2);
    // Each flight but the first three starts from a speed that the reset says.
    const double made = one_step(method) ? 400.0 * eps * 20.0 : 40.0 * (rtol * 4.0 + atol) / 1.0;
    within(text("driven ball ", form.name), method, worst(firing_times(results.events), expected),
           static_cast<double>(expected.size()) * made);
  }
}
