// Guards of discrete state: nothing but a tick moves them, so they fire at a tick, a pass after it.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Counts ticks of 0.01 s in z0; at `n` of them it starts anew and counts that in z1.
std::shared_ptr<Leaf> counter(int n, bool with_state) {
  return make_leaf("counter", [=](Leaf& l) {
    if (with_state) declare_ramp(l);
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0, at.z[1]}); }, 0.01,
        0.01, "tick");
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [=](const At& at) { return at.z[0] - (n - 0.5); },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({0.0, at.z[1] + 1.0}); },
         .direction = Direction::negative_then_non_negative});
  });
}

}  // namespace

TEST_CASE("a counter of ticks overflows at its tick, and starts anew", "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_state = GENERATE(true, false);
  const int n = GENERATE(1, 3, 10);
  for (const Form& form : forms(counter(n, with_state))) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 10.0}, {.ode_solver_method = method});
    INFO(form.name << ", method " << method << ", n " << n << ", state " << with_state);
    CHECK(results.context.discrete_state() ==
          vec({1000.0 - n * std::floor(1000.0 / n), std::floor(1000.0 / n)}));
    std::vector<double> expected;
    for (int k = n; k <= 1000; k += n) expected.push_back(0.01 * k);
    within(text("counter ", n, " ", form.name), method,
           worst(firing_times(results.events), expected), 8.0 * eps * 10.0);
  }
}

TEST_CASE("limits of steps change no event", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 0.7; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  std::vector<double> expected;
  for (int k = 1; k <= 14; ++k) expected.push_back(0.7 * k);
  for (const double step : {1e-3, 0.1, 0.7, 5.0}) {
    for (const bool major : {false, true}) {
      SimulatorOptions options{.ode_solver_method = method};
      (major ? options.max_major_step_length : options.max_minor_step_size) = step;
      const auto results = simulate(*leaf, leaf->create_context(), {0.0, 10.0}, options);
      // x = t, each of up to 1e4 steps rounds it; 14 locations of 100 eps (t + h).
      within(text("steps of ", step, major ? " major" : ""), method,
             worst(firing_times(results.events), expected),
             (14.0 * 200.0 * 10.0 + 0.7 / step) * eps);
    }
  }
}
