// What reset maps of one instant do to each other: un-trip, trip, jump over, write what was there.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 with guards that all reach zero at x = 0.5.
template <class Declare>
std::shared_ptr<Leaf> ramp_with(Declare declare) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0, 0.0}));
    declare(l);
  });
}

double half(const At& at) { return at.x[0] - 0.5; }

/// Adds one to discrete state i; x goes to `to`, if it is given.
ResetMap tick(int i, std::optional<double> to = {}) {
  return [=](const At& at, Next& next) {
    next.set_discrete_state(at.z + Eigen::VectorXd::Unit(2, i));
    if (to) next.set_continuous_state({*to});
  };
}

Results run(const System& system, Method method, double end = 1.0) {
  return simulate(system, system.create_context(), {0.0, end}, {.ode_solver_method = method});
}

void jumps_over(Method method, Direction direction) {
  const auto leaf = ramp_with([=](Leaf& l) {
    l.declare_zero_crossing({.name = "full", .guard = half, .reset_map = tick(0, 0.0)});
    l.declare_zero_crossing({.name = "level",
                             .guard = [](const At& at) { return at.x[0] - 0.25; },
                             .reset_map = tick(1),
                             .direction = direction});
  });
  for (const Form& form : forms(leaf)) {
    const auto results = run(*form.system, method, 2.1);
    // Sawtooth: up through the level at 0.25, 0.75, ..., 1.75; jumps back over it at 0.5,
    // 1, 1.5, 2.
    const double ups = direction == Direction::positive_then_non_positive ? 0.0 : 4.0,
                 downs = direction == Direction::negative_then_non_negative ? 0.0 : 4.0;
    INFO(form.name << ", method " << method << ", " << to_string(direction));
    CHECK(results.context.discrete_state() == vec({4.0, ups + downs}));
    for (std::size_t i = 1; i < results.events.size(); ++i) {
      if (results.events[i].direction < 0)
        CHECK(results.events[i].time == results.events[i - 1].time);
    }
  }
}

}  // namespace

TEST_CASE("two guards fire together, though the first reset un-trips the second",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = ramp_with([](Leaf& l) {
    l.declare_zero_crossing({.name = "back", .guard = half, .reset_map = tick(0, -10.0)});
    l.declare_zero_crossing({.name = "late", .guard = half, .reset_map = tick(1)});
  });
  for (const Form& form : forms(leaf)) {
    const auto results = run(*form.system, method);
    CHECK(results.context.discrete_state() == vec({1.0, 1.0}));
    REQUIRE(results.events.size() == 2);
    CHECK(results.events[0].jump == 1);
    CHECK(results.events[1].jump == 1);
    within(text("un-trip ", form.name), method,
           std::abs(results.context.continuous_state()[0] - (-10.0 + 0.5)), 400.0 * eps * 10.0);
  }
}

TEST_CASE("a reset that jumps over a level crosses it, in its direction, at the same time",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  jumps_over(method, Direction::crosses_zero);
  jumps_over(method, Direction::negative_then_non_negative);
}

TEST_CASE("a guard that a reset jumped over, on its far side now, is no Zeno point",
          "[laws][passes][zeno]") {
  jumps_over(GENERATE(from_range(methods)), Direction::positive_then_non_positive);
}

TEST_CASE("a reset that writes what was there is a reset: an event, two rows, a restart",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  const bool tick_too = GENERATE(false, true);
  const auto leaf = ramp_with([=](Leaf& l) {
    const auto same = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); };
    if (tick_too)
      l.declare_one_shot(0.5, same, "same");
    else
      l.declare_zero_crossing({.name = "same", .guard = half, .reset_map = same});
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0},
                 {.ode_solver_method = method, .recorded_signals = {{"x", leaf->output()}}});
    INFO(form.name << ", method " << method);
    REQUIRE(results.events.size() == 1);
    CHECK(rows_at(results, results.events[0].time).size() == 2);
    CHECK(results.statistics.restarts == 1);
    CHECK(std::ranges::equal(results.events[0].before, results.events[0].after));
  }
}

TEST_CASE("a reset of what no derivative reads restarts nothing and moves nothing",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  const auto oscillator = [](bool counted) {
    return make_leaf("leaf", [=](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
           .reads = Reads::continuous_state});
      l.declare_discrete_state(vec({0.0}));
      if (counted)
        l.declare_zero_crossing({.name = "count",
                                 .guard = [](const At& at) { return at.x[0] - 0.3; },
                                 .reset_map = count_up});
    });
  };
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : forms(oscillator(true))) {
    const auto results = simulate(*form.system, form.context(), {0.0, 20.0},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    CHECK(results.statistics.restarts == 0);
    within(text("counted, not restarted ", form.name), method,
           std::abs(results.context.continuous_state()[0] - std::cos(20.0)),
           allowed(method, rtol, atol, 1.0, 20.0));
  }
}
