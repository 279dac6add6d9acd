// Semantics 5.2 and 5.7: the same run twice gives the same bits; what is recorded changes none of
// them.
#include <thread>

#include "support/balls.hpp"

using namespace saltus;
using namespace support;

namespace {

/// What a run computes, whatever it shows.
struct Outcome {
  Context context;
  EventLog events;
};

Outcome run(const BallScene& scene, SimulatorOptions options) {
  auto results = simulate(*scene.system, scene.context(1.0, 0.3), {0.0, 4.0}, options);
  return {results.context, results.events};
}

std::vector<BallScene> scenes() {
  const auto step = [] {
    return std::make_shared<Step>("floor", Step::Options{.end_value = -0.5, .step_time = 3.5});
  };
  return all_forms_over({.e = 0.6}, step);
}

}  // namespace

TEST_CASE("5.7 the same run twice gives the same bits", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : scenes()) {
    INFO(scene.form << ", method " << method);
    const Outcome a = run(scene, {.ode_solver_method = method}),
                  b = run(scene, {.ode_solver_method = method});
    CHECK(same_bits(a.context, b.context));
    CHECK(same_bits(a.events, b.events));
  }
}

TEST_CASE("5.7 a simulator that is initialized again repeats its run bit for bit", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : scenes()) {
    INFO(scene.form << ", method " << method);
    Simulator simulator(*scene.system,
                        {.ode_solver_method = method, .recorded_signals = {{"y", scene.height}}});
    simulator.initialize(scene.context(1.0, 0.3));
    simulator.advance_to(4.0);
    const Results first = simulator.results();
    simulator.initialize(scene.context(1.0, 0.3));
    simulator.advance_to(4.0);
    const Results& second = simulator.results();
    CHECK(same_bits(first.context, second.context));
    CHECK(same_bits(first.events, second.events));
    CHECK(first.time == second.time);
    CHECK(column(first, "y") == column(second, "y"));
    CHECK(first.statistics.steps == second.statistics.steps);
    CHECK(first.statistics.events == second.statistics.events);
    CHECK(first.statistics.restarts == second.statistics.restarts);
  }
}

TEST_CASE("5.2 recording changes no bit of the context and of the event log", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : scenes()) {
    INFO(scene.form << ", method " << method);
    const RecordedSignals signals{{"y", scene.height}};
    std::vector<double> times;
    for (int i = 0; i <= 400; ++i) times.push_back(0.01 * i);
    const Outcome bare = run(scene, {.ode_solver_method = method});
    const std::vector<SimulatorOptions> all{
        {.ode_solver_method = method, .recorded_signals = signals},
        {.ode_solver_method = method, .recorded_signals = signals, .save_at = times},
        {.ode_solver_method = method,
         .recorded_signals = signals,
         .save_at = times,
         .save_steps = true},
        {.ode_solver_method = method,
         .recorded_signals = signals,
         .save_at = {0.123},
         .save_steps = false},
        {.ode_solver_method = method, .save_at = times}};
    for (const SimulatorOptions& options : all) {
      const Outcome shown = run(scene, options);
      CHECK(same_bits(shown.context, bare.context));
      CHECK(same_bits(shown.events, bare.events));
    }
    const Outcome silent = run(scene, {.ode_solver_method = method, .record_events = false});
    CHECK(same_bits(silent.context, bare.context));
    CHECK(silent.events.empty());
  }
}

TEST_CASE("5.7 two threads over one system give the bits of one", "[semantics]") {
  const auto method = GENERATE(Method::dopri5, Method::bdf);
  for (const BallScene& scene : scenes()) {
    INFO(scene.form << ", method " << method);
    const Outcome alone = run(scene, {.ode_solver_method = method});
    Outcome a, b;
    std::thread first([&] { a = run(scene, {.ode_solver_method = method}); });
    std::thread second([&] { b = run(scene, {.ode_solver_method = method}); });
    first.join(), second.join();
    CHECK((same_bits(a.context, alone.context) && same_bits(a.events, alone.events)));
    CHECK((same_bits(b.context, alone.context) && same_bits(b.events, alone.events)));
  }
}
