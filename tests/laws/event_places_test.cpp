// Where in a run an event may fall: at t0, at the end, on a time that is saved, on a tick, all of
// them at once; and what a terminal one does there.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 from t0 on; a guard at x = `at`, counted, and ticks of 0.1 s, counted.
std::shared_ptr<Leaf> clock(double at, bool terminal = false) {
  return make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_discrete_state_output("z");
    l.declare_zero_crossing({.name = "reached",
                             .guard = [=](const At& now) { return now.x[0] - at; },
                             .reset_map =
                                 [](const At& now, Next& next) {
                                   next.set_discrete_state({now.z[0] + 1.0, now.z[1]});
                                   next.set_continuous_state({now.x[0]});
                                 },
                             .direction = Direction::negative_then_non_negative,
                             .terminal = terminal});
    l.declare_periodic_update(
        [](const At& now, Next& next) { next.set_discrete_state({now.z[0], now.z[1] + 1.0}); },
        0.1);
  });
}

void cut_in_two(Method method, const std::vector<double>& cuts) {
  // The located time may be a rounding before the cut, on it, or behind it.
  for (const double cut : cuts) {
    for (const Form& form : forms(clock(0.5))) {
      const SimulatorOptions options{.ode_solver_method = method};
      const auto first = simulate(*form.system, form.context(), {0.0, cut}, options);
      const auto second = simulate(*form.system, first.context, {cut, 1.0}, options);
      INFO(form.name << ", method " << method << ", cut " << cut - 0.5);
      CHECK(first.events.times("reached").size() + second.events.times("reached").size() == 1);
      CHECK(second.context.discrete_state()[1] == 11.0);
    }
  }
}

}  // namespace

TEST_CASE("an event on a tick and on a time that is saved happens once", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  // 0.5 is a tick to the last bit, 0.3 = 3 * 0.1 is one but for it.
  const double at = GENERATE(0.5, 0.3, 0.7);
  for (const Form& form : forms(clock(at))) {
    INFO(form.name << ", method " << method << ", at " << at);
    std::vector<double> times;
    for (int i = 0; i <= 10; ++i) times.push_back(0.1 * i);
    const auto results = simulate(*form.system, form.context(), {0.0, 1.0},
                                  {.ode_solver_method = method, .save_at = times});
    CHECK(results.context.discrete_state()[1] == 11.0);
    within(text("event on a tick ", form.name), method, worst(firing_times(results.events), {at}),
           200.0 * eps);
    for (std::size_t i = 1; i < results.events.size(); ++i)
      CHECK(results.events[i].time >= results.events[i - 1].time);
  }
}

TEST_CASE("a reset and a tick of one leaf at one time both count", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const double at = GENERATE(0.5, 0.3, 0.7);
  for (const Form& form : forms(clock(at))) {
    INFO(form.name << ", method " << method << ", at " << at);
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    CHECK(results.context.discrete_state() == vec({1.0, 11.0}));
  }
}

TEST_CASE("rows at saved times are the same with an event exactly there", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = clock(0.5);
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 1.0},
                                {.ode_solver_method = method,
                                 .recorded_signals = {{"x", leaf->output("x")}},
                                 .save_at = {0.25, 0.5, 0.75},
                                 .save_steps = false});
  const auto x = column(results, "x");
  REQUIRE(x.size() == results.time.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    within("rows at events and saved times", method, std::abs(x[i] - results.time[i]), 20.0 * eps);
    if (i > 0) CHECK(results.time[i] >= results.time[i - 1]);
  }
  for (const double t : {0.25, 0.5, 0.75}) CHECK(!rows_at(results, t).empty());
}

TEST_CASE("a run that is cut before an event has it once, in the piece after", "[laws][events]") {
  cut_in_two(GENERATE(from_range(methods)), {0.25, 0.5, std::nextafter(0.5, 0.0), 0.5 - 1e-12});
}

TEST_CASE("a run that is cut at an event has it once, in the piece before or the one after",
          "[laws][events]") {
  cut_in_two(GENERATE(from_range(methods)),
             {std::nextafter(0.5, 1.0), 0.5 + 4.0 * eps, 0.5 + 1e-12, 0.75});
}

// What comes out with adams and bdf at t0 = 0: an error, "tout too close to t0".
TEST_CASE("a run of one rounding error's length runs", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const double t0 = GENERATE(0.0, 0.5, -5.0, 1e8);
  for (const Form& form : forms(clock(0.5))) {
    const double end = std::nextafter(t0, infinite);
    const auto results = simulate(*form.system, form.context(t0), {t0, end},
                                  {.ode_solver_method = method, .throw_errors = false});
    INFO(form.name << ", method " << method << ", t0 " << t0);
    CHECK(results.status == Status::reached_end);
    CHECK(results.context.time() == end);
  }
}

TEST_CASE("a terminal contact at t0 ends the run there, after its reset", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const double t0 = GENERATE(0.0, -5.0, 1e8);
  for (const Form& form : forms(clock(0.0, true))) {
    const auto results =
        simulate(*form.system, form.context(t0), {t0, t0 + 1.0}, {.ode_solver_method = method});
    INFO(form.name << ", method " << method << ", t0 " << t0);
    CHECK(results.status == Status::terminal);
    CHECK(results.context.time() == t0);
    CHECK(results.context.discrete_state()[0] == 1.0);
    CHECK(results.statistics.steps == 0);
  }
}

TEST_CASE("a terminal event exactly at the end is a terminal event", "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "end", .guard = [](const At& at) { return at.time - 1.0; }, .terminal = true});
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    INFO(form.name << ", method " << method);
    CHECK(results.status == Status::terminal);
    CHECK(results.context.time() == 1.0);
  }
}

TEST_CASE("of a terminal event and later ones in one step only the terminal one happens",
          "[laws][events]") {
  const auto method = GENERATE(from_range(methods));
  const auto leaf = make_leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (const double at : {0.5, 0.5 + 1e-9, 0.7}) {
      l.declare_zero_crossing({.name = text("at_", at),
                               .guard = [=](const At& now) { return now.x[0] - at; },
                               .reset_map = count_up,
                               .terminal = at == 0.5});
    }
    l.declare_zero_crossing(
        {.name = "monitor", .guard = [](const At& now) { return now.x[0] - 0.6; }});
  });
  for (const Form& form : forms(leaf)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, 1.0}, {.ode_solver_method = method});
    INFO(form.name << ", method " << method);
    CHECK(results.status == Status::terminal);
    CHECK(results.context.discrete_state()[0] == 1.0);
    CHECK(results.events.times("monitor").empty());
  }
}
