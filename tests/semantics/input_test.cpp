// Semantics 6: what else is refused before a run, and what ends it without a trace on the terminal.

#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf square() {  // x' = x^2, infinite at t = 1
  return Leaf("square", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.x[0] * at.x[0]; }});
  });
}

}  // namespace

TEST_CASE("6.1 a parameter that is unknown, of the wrong shape or not finite is refused",
          "[semantics]") {
  const Leaf leaf("leaf", [](Leaf& l) { l.declare_dynamic_parameter("gravity", 9.81); });
  const Context context = leaf.create_context();
  const auto refused = [&](const char* name, const Eigen::VectorXd& value) {
    return message<ModelError>([&] { context.with_parameter(name, value); });
  };
  CHECK(contains(refused("gravitiy", vec({1.0})), "did you mean 'gravity'?"));
  CHECK(contains(refused("gravity", vec({1.0, 2.0, 3.0})), "expected 1 values, found 3"));
  CHECK(contains(refused("gravity", vec({not_a_number})), "finite"));
  CHECK(contains(message<ModelError>([] {
                   Leaf("leaf", [](Leaf& l) { l.declare_dynamic_parameter("p", infinite); });
                 }),
                 "finite"));
}

TEST_CASE("6.1 t1 < t0 is refused before anything is called", "[semantics]") {
  int calls = 0;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [&](const At&) { return ++calls, 1.0; }});
  });
  CHECK(contains(message<ModelError>([&] { simulate(leaf, leaf.create_context(), {1.0, 0.0}); }),
                 "begin <= end"));
  CHECK(calls == 0);
}

TEST_CASE("6.2 a run that fails prints nothing, whatever the solver has to say", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = square();
  std::string what;
  const std::string printed = printed_by([&] {
    what = message<SimulationError>(
        [&] { simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method}); });
  });
  CHECK(printed == "");
  CHECK(contains(what, "t = "));
}

TEST_CASE("6.3 t1 == t0 has the rows of the start instant, with what happens at it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_one_shot(3.0, [](const At&, Next& next) { next.set_continuous_state({7.0}); });
  });
  const auto results =
      simulate(leaf, leaf.create_context(3.0), {3.0, 3.0},
               {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  CHECK(results.time == std::vector{3.0, 3.0});
  CHECK(results.jump == std::vector{0, 1});
  CHECK(column(results, "x") == std::vector{0.0, 7.0});
  CHECK(results.statistics.steps == 0);
}

TEST_CASE("6.4 an interrupt ends a run at once, also where instant follows instant",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  int asked = 0, calls_after = 0;
  const Leaf saw("saw", [&](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [&](const At&) {
                                  calls_after += asked == 3;
                                  return 1.0;
                                }});
    l.declare_zero_crossing(
        {.guard = [](const At& at) { return at.x[0] - 1e-3; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  const auto results = simulate(saw, saw.create_context(), {0.0, 1e9},
                                {.ode_solver_method = method,
                                 .record_events = false,
                                 .throw_errors = false,
                                 .interrupt = [&] { return ++asked == 3; }});
  CHECK(results.status == Status::interrupted);
  CHECK(results.context.time() > 0.0);
  CHECK(asked == 3);
  CHECK(calls_after <= 1);  // the last row may ask for it
}
