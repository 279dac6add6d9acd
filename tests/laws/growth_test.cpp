// Errors that grow, and equations that are stiff, between events whose times are known: x' = x from
// 1 to e in 1 s, a relay over a fast lag, a sum of a thousand states.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

void stiff_lag(Method method, double stiffness) {
  // y' = stiffness (T - y) follows T at a distance T' / stiffness; T runs from -1 to 1 and back at
  // 1/s, turned by y: a period of 4 (1 + 1/stiffness) s, but for the first, from rest.
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, -1.0 / stiffness}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << (at.mode == 1 ? 1.0 : -1.0), stiffness * (at.x[0] - at.x[1]);
         }});
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "high",
                             .guard = [](const At& at) { return at.x[1] - 1.0; },
                             .start_mode = 1,
                             .end_mode = 0});
    l.declare_zero_crossing({.name = "low",
                             .guard = [](const At& at) { return at.x[1] + 1.0; },
                             .start_mode = 0,
                             .end_mode = 1});
  });
  const double rtol = 1e-8, atol = 1e-10;
  std::vector<double> expected{1.0 + 1.0 / stiffness};  // y + 1/stiffness = T = t
  while (expected.size() < 8) expected.push_back(expected.back() + 2.0 + 2.0 / stiffness);
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, expected.back() + 0.5},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // At a switch T turns, y overshoots by log(2) / stiffness of time and is back on its line, at
    // the other side, long before the next. y is one local error off, T exact.
    within(text("stiff lag ", stiffness, " ", form.name), method,
           worst(firing_times(results.events), expected),
           8.0 * 2.0 * allowed(method, rtol, atol, 1.0));
  }
}

}  // namespace

TEST_CASE("an unstable state that is put back at e comes there every second", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = 1e-9, atol = 1e-11;
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.x[0]; }});
    l.declare_zero_crossing(
        {.name = "back",
         .guard = [](const At& at) { return at.x[0] - std::exp(1.0); },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({1.0}); }});
  });
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 50.5},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    std::vector<double> expected;
    for (int k = 1; k <= 50; ++k) expected.push_back(k);
    // The reset says the state: an error lives for one second, in which it grows by e, and is one
    // of time, over x' = e. The times add up.
    within(text("unstable ", form.name), method, worst(firing_times(results.events), expected),
           50.0 * allowed(method, rtol, atol, 1.0));
  }
}

TEST_CASE("a stiff lag under a relay switches on time", "[laws][modes]") {
  stiff_lag(GENERATE(from_range(methods)), GENERATE(1e2, 1e4));
}

TEST_CASE("a guard over a thousand states fires when their sum says", "[laws]") {
  const auto method = GENERATE(Method::dopri5, Method::adams,
                               Method::automatic);  // a dense Jacobian of 1e6 is not for here
  const Index n = 1000;
  const double rtol = 1e-9, atol = 1e-11;
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::Ones(n),
                                .ode = [](const At& at, VectorRef xdot) { xdot = -at.x; }});
    l.declare_zero_crossing(
        {.name = "half",
         .guard = [](const At& at) { return at.x.sum() - 0.5 * 1000.0; },
         .reset_map = [=](const At&,
                          Next& next) { next.set_continuous_state(Eigen::VectorXd::Ones(n)); }});
  });
  for (const Form& form : forms(leaf)) {
    const auto results = simulate(*form.system, form.context(), {0.0, 7.5 * std::log(2.0)},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    std::vector<double> expected;
    for (int k = 1; k <= 7; ++k) expected.push_back(k * std::log(2.0));
    // All states err alike, by ten tolerances, over x' = 0.5.
    within(text("thousand states ", form.name), method,
           worst(firing_times(results.events), expected),
           7.0 * 2.0 * allowed(method, rtol, atol, 1.0));
  }
}
