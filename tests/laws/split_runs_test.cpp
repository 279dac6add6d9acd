// A run in pieces is the run: no tick twice, none lost, the same events.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

Leaf counter(double period, double offset, bool with_state) {
  return Leaf("counter", [=](Leaf& l) {
    if (with_state) declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("count");
    l.declare_periodic_update(count_up, period, offset);
  });
}

double ticks(const Leaf& leaf, const std::vector<double>& stops, bool recorded) {
  auto context = leaf.create_context();
  double from = 0.0;
  for (const double stop : stops) {
    SimulatorOptions options;
    if (recorded) options.recorded_signals = {{"count", leaf.output("count")}};
    context = simulate(leaf, context, {from, stop}, options).context;
    from = stop;
  }
  return context.discrete_state()[0];
}

}  // namespace

TEST_CASE("ticks are counted the same in one run and in many, recorded or not", "[laws][split]") {
  const bool with_state = GENERATE(true, false);
  const bool recorded = GENERATE(true, false);
  INFO("state " << with_state << ", recorded " << recorded);
  const Leaf tenth = counter(0.1, 0.0, with_state), third = counter(1.0 / 3.0, 0.0, with_state);
  CHECK(ticks(tenth, {1.0}, recorded) == 11.0);  // at 0, 0.1, ..., 1
  CHECK(ticks(tenth, {0.5, 1.0}, recorded) == 11.0);
  CHECK(ticks(tenth, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}, recorded) == 11.0);
  CHECK(ticks(tenth, {0.05, 0.3, 0.3, 0.31, 1.0}, recorded) == 11.0);
  CHECK(ticks(third, {1000.0 / 3.0}, recorded) == 1001.0);
  CHECK(ticks(third, {1.0, 100.0, 200.0, 1000.0 / 3.0}, recorded) == 1001.0);
  CHECK(ticks(counter(0.25, 0.1, with_state), {1.0}, recorded) == 4.0);
  CHECK(ticks(counter(0.25, 0.1, with_state), {0.1, 0.35, 0.6, 1.0}, recorded) == 4.0);
}

TEST_CASE("a run that goes on from results.context has the events of the unbroken run",
          "[laws][split]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.8})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
    const auto whole = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0}, options);
    const auto first = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 1.0}, options);
    const auto second = simulate(*scene.system, first.context, {1.0, 3.0}, options);
    auto kinds = events(first.events);
    const auto rest = events(second.events);
    kinds.insert(kinds.end(), rest.begin(), rest.end());
    CHECK(kinds == events(whole.events));
    // Errors of 20 steps a flight, carried on over five flights.
    CHECK_THAT(second.context.continuous_state()[0],
               WithinAbs(whole.context.continuous_state()[0], 1e-6));
  }
}

TEST_CASE("a run split where the ball rests goes on resting", "[laws][split]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.5})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.ode_solver_method = method};
    const auto first = simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0}, options);
    const auto second = simulate(*scene.system, first.context, {3.0, 6.0}, options);
    CHECK_THAT(second.context.continuous_state()[0], WithinAbs(0.0, 1e-6));
    CHECK_THAT(second.context.continuous_state()[1], WithinAbs(0.0, 1e-5));
  }
}

TEST_CASE("advance_to in pieces has the events of one run, and its numbers to the tolerance",
          "[laws][split]") {
  const auto method = GENERATE(from_range(methods));
  for (const BallScene& scene : all_forms({.e = 0.8})) {
    INFO(scene.form << ", method " << method);
    const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
    Simulator whole(*scene.system, options), pieces(*scene.system, options);
    whole.initialize(scene.context(1.0, 0.0)), pieces.initialize(scene.context(1.0, 0.0));
    whole.advance_to(3.0);
    for (int i = 1; i <= 30; ++i) pieces.advance_to(0.1 * i);
    CHECK(events(pieces.results().events) == events(whole.results().events));
    CHECK_THAT(pieces.context().continuous_state()[0],
               WithinAbs(whole.context().continuous_state()[0], 1e-6));
  }
}

TEST_CASE("without continuous state advance_to in pieces is one run bit for bit", "[laws][split]") {
  const Leaf leaf = counter(1.0 / 3.0, 0.05, false);
  Simulator whole(leaf), pieces(leaf);
  whole.initialize(leaf.create_context()), pieces.initialize(leaf.create_context());
  whole.advance_to(100.0);
  for (int i = 1; i <= 1000; ++i) pieces.advance_to(0.1 * i);
  CHECK(same_bits(pieces.results().events, whole.results().events));
  CHECK(pieces.context().discrete_state() == whole.context().discrete_state());
}
