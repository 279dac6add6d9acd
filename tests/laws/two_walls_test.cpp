// Impacts between two walls, and impacts of an oscillator: times that no restitution changes, or
// that grow geometrically.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

/// A ball from 0 to `length` and back, without gravity: two guards, one reset map.
std::shared_ptr<Leaf> between_walls(double length, double e) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.25 * length, 1.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], 0.0; }});
    l.declare_zero_crossing(
        {.name = "left",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
    l.declare_zero_crossing(
        {.name = "right",
         .guard = [=](const At& at) { return at.x[0] - length; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({length, -e * at.x[1]}); },
         .direction = Direction::negative_then_non_negative});
  });
}

/// x'' = -x with a wall at 0: half a turn from impact to impact, however fast.
std::shared_ptr<Leaf> impact_oscillator(double e) {
  return make_leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_zero_crossing(
        {.name = "wall",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("between two walls each way takes 1/e times as long as the one before", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double length = GENERATE(1.0, 1e-6, 1e6);
  for (const double e : {1.0, 0.9, 0.5}) {
    for (const Form& form : forms(between_walls(length, e))) {
      std::vector<double> expected{0.75 * length};
      std::vector<std::string> names{"right"};
      double speed = 1.0;
      for (int k = 1; k < 20; ++k) {
        speed *= e;
        expected.push_back(expected.back() + length / speed);
        names.emplace_back(k % 2 == 1 ? "left" : "right");
      }
      const double end = expected.back() + 0.5 * length / speed;
      const auto results =
          simulate(*form.system, form.context(), {0.0, end},
                   {.rtol = 1e-9, .atol = 1e-12 * length, .ode_solver_method = method});
      INFO("length " << length);
      CHECK(firing_names(results.events) == names);
      // The velocity is constant: nothing to integrate, for any method. What is left is the
      // rounding of a location, 100 eps (|t| + |h|) each, and of the heights, which a slow way
      // turns into 1/speed times as much time.
      const double tolerance = 20.0 * (200.0 * eps * end + 10.0 * eps * length / speed);
      within(text("two walls e=", e, " ", form.name), method,
             worst(firing_times(results.events), expected) / end, tolerance / end);
      CHECK_THAT(results.context.continuous_state()[1],
                 Catch::Matchers::WithinRel(e * speed, 1e-13));
    }
  }
}

TEST_CASE("an oscillator meets its wall at every pi, whatever the restitution", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  for (const double e : {1.0, 0.8, 0.3}) {
    const double rtol = 1e-9, atol = 1e-14;
    for (const Form& form : forms(impact_oscillator(e))) {
      const int n = 12;
      const auto results = simulate(*form.system, form.context(), {0.0, (n + 0.5) * pi},
                                    {.rtol = rtol, .atol = atol, .ode_solver_method = method});
      std::vector<double> expected;
      for (int k = 1; k <= n; ++k) expected.push_back(pi * k);
      // An error dx at the wall is a time dx / v; v and the errors of a half turn shrink alike, and
      // atol stays: at the last impact the speed is e^n. Errors of n half turns add up.
      const double slowest = std::pow(e, n);
      within(text("impact oscillator e=", e, " ", form.name), method,
             worst(firing_times(results.events), expected),
             n * allowed(method, rtol, atol / slowest, 1.0, pi));
      within(text("impact oscillator speed e=", e, " ", form.name), method,
             std::abs(results.context.continuous_state()[0] / slowest - 1.0),
             n * allowed(method, rtol, atol / slowest, 1.0, pi));
    }
  }
}
