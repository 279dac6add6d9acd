// Runs that cannot go on: blow-up, underflow, step limits. They end in bounded time with what was
// reached.

#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf blow_up() {
  return Leaf("blow_up", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.x[0] * at.x[0]; }});
    l.declare_continuous_state_output("x");
  });
}

}  // namespace

TEST_CASE("x' = x^2 blows up at t = 1: the error says where, with the partial results",
          "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = blow_up();
  std::string message_text;
  const std::string printed = printed_by([&] {
    try {
      simulate(leaf, leaf.create_context(), {0.0, 2.0},
               {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
    } catch (const SimulationError& error) {
      message_text = error.what();
      if (std::abs(error.time() - 1.0) > 1e-3) message_text += " at the wrong time";
      if (!error.results() || error.results()->time.size() < 5) message_text += " without results";
    }
  });
  INFO(message_text);
  CHECK(
      (contains(message_text, "blows up in finite time") || contains(message_text, "not finite")));
  CHECK(!contains(message_text, "wrong time"));
  CHECK(!contains(message_text, "without results"));
  CHECK(printed == "");
}

TEST_CASE("a jump that no guard announces, too sharp for the tolerance, does not hang a run",
          "[errors]") {
  const auto method = GENERATE(
      Method::dopri5, Method::automatic);  // CVODE's error estimate does not see such a jump at all
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.x[0] < 0.5 ? 1.0 : -1.0; }});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 2.0},
               {.ode_solver_method = method, .max_major_steps = 100, .throw_errors = false});
  CHECK(results.statistics.steps < 100000);
  CHECK((results.status == Status::failed ||
         std::abs(results.context.continuous_state()[0] - 0.5) < 1e-3));
}

TEST_CASE("a step below min_minor_step_size is an error that names the option", "[errors]") {
  const Leaf leaf = blow_up();
  const std::string what = message<SimulationError>([&] {
    simulate(leaf, leaf.create_context(), {0.0, 2.0},
             {.ode_solver_method = Method::dopri5, .min_minor_step_size = 1e-3});
  });
  CHECK(contains(what, "below min_minor_step_size = 0.001 s; lower that, or loosen rtol and atol"));
}

TEST_CASE("max_major_steps ends a run with the status step_limit and all it has", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, 0.1, 0.1);
  });
  const SimulatorOptions options{.ode_solver_method = method,
                                 .max_major_steps = 5,
                                 .recorded_signals = {{"x", leaf.output()}}};
  try {
    simulate(leaf, leaf.create_context(), {0.0, 1.0}, options);
    FAIL("no exception");
  } catch (const SimulationError& error) {
    CHECK(contains(error.what(), "used its 5 major steps before t = 1 s; raise max_major_steps"));
    REQUIRE(error.results());
    CHECK(error.results()->status == Status::step_limit);
    CHECK(error.results()->time.back() == error.time());
    CHECK(error.time() < 0.6);
  }
  SimulatorOptions quiet = options;
  quiet.throw_errors = false;
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1.0}, quiet);
  CHECK(results.status == Status::step_limit);
  CHECK(results.context.discrete_state()[0] == std::round(results.context.time() / 0.1));
}

TEST_CASE("an interrupt ends a run with what it has", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  const bool with_ticks = GENERATE(true, false);
  INFO("method " << method << ", ticks " << with_ticks);
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_discrete_state(vec({0.0}));
    if (with_ticks) l.declare_periodic_update(count_up, 1e-3);
  });
  int times = 0;
  const auto asked = [&] { return ++times == 3; };
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 1e9},
                                {.ode_solver_method = method,
                                 .record_events = false,
                                 .throw_errors = false,
                                 .interrupt = asked});
  CHECK(results.status == Status::interrupted);
  CHECK(times == 3);  // who said yes is not asked again
  CHECK(results.context.time() > 0.0);
}

TEST_CASE("an interrupt is heard without continuous state too", "[errors]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update(count_up, 1e-3);
  });
  int times = 0;
  const auto asked = [&] { return ++times == 3; };
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1e5},
               {.record_events = false, .throw_errors = false, .interrupt = asked});
  CHECK(results.status == Status::interrupted);
}
