// Equations that end where their event is: a draining tank, h' = -2 sqrt(h), refilled when low; and
// y' = -1 / (2 y), which has no value beyond 0. The solver must not trip over what lies behind.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Below `low` it is refilled to 1. From 1, h = (1 - t)^2. No value below 0.
std::shared_ptr<Leaf> tank(double low) {
  return make_leaf("tank", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return -2.0 * std::sqrt(at.x[0]); }});
    l.declare_zero_crossing(
        {.name = "low",
         .guard = [=](const At& at) { return at.x[0] - low; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({1.0}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// y = sqrt(1 - t), ends at `low`.
std::shared_ptr<Leaf> root(double low) {
  return make_leaf("root", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  return at.x[0] > 0.0 ? -0.5 / at.x[0] : not_a_number;
                                }});
    l.declare_zero_crossing(
        {.name = "low", .guard = [=](const At& at) { return at.x[0] - low; }, .terminal = true});
  });
}

void ends(Method method, double low) {
  const double rtol = 1e-9, atol = 1e-12;
  for (const Form& form : forms(root(low))) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 2.0},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
    CHECK(results.status == Status::terminal);
    // y dy is conserved: an error dy made at y is dy y / low at the end, and over y' = 1 / (2 low)
    // a time of 2 y dy.
    within(text("root low=", low, " ", form.name), method,
           std::abs(results.context.time() - (1.0 - low * low)),
           2.0 * allowed(method, rtol, atol, 1.0));
  }
}

}  // namespace

TEST_CASE("a draining tank is refilled when its parabola says", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double low = GENERATE(0.25, 1e-2, 1e-4);
  const double rtol = 1e-9, atol = 1e-12;
  for (const Form& form : forms(tank(low))) {
    const double period = 1.0 - std::sqrt(low);
    const int n = 20;
    std::vector<double> expected;
    for (int k = 1; k <= n; ++k) expected.push_back(k * period);
    const auto results = simulate(*form.system, form.context(), {0.0, (n + 0.5) * period},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // d(dh)/dt = -dh / sqrt(h): errors shrink as sqrt(h) does, so one made at h is dh sqrt(low /
    // h), and over h' = 2 sqrt(low) a time of dh / (2 sqrt(h)): most are made where h is 1. What
    // atol leaves at the end is a time of atol / (2 sqrt(low)).
    const double once = allowed(method, rtol, atol / std::sqrt(low), 1.0) / 2.0;
    within(text("Torricelli low=", low, " ", form.name), method,
           worst(firing_times(results.events), expected), n * once);
  }
}

TEST_CASE("a run ends where its equation is about to, one-step methods", "[laws]") {
  ends(GENERATE(filter(one_step, from_range(methods))), GENERATE(0.1, 1e-2));
}

// What comes out: with dopri5 14 tolerances of y at 0.5, in the middle of a long step, where its
// interpolant of order 4 is behind the step; with adams 21.
TEST_CASE("a run ends where its equation is about to", "[.engine][laws]") {
  ends(GENERATE(from_range(methods)), GENERATE(0.5, 0.1, 1e-2));
}
