// Pulse-coupled neurons: one that fires pushes its neighbours, and may push them over their own
// thresholds at the same time. All in one leaf, and one block each.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr int n = 5;
constexpr double current = 1.5, push = 0.1;

/// V' = current - V; from V = v the threshold 1 is log((current - v) / (current - 1)) away.
double wait(double v) { return std::log((current - v) / (current - 1.0)); }

/// One neuron: input 0 is how often its neighbour has fired so far, output the same of itself.
std::shared_ptr<Leaf> neuron(int i, double v0) {
  return make_leaf(text("neuron_", i), [=](Leaf& l) {
    const int in = l.declare_input_port({.name = "neighbour", .shape = Shape::scalar()});
    l.declare_continuous_state({.initial = vec({v0}),
                                .ode = [](const At& at) { return current - at.x[0]; },
                                .reads = Reads::continuous_state});
    l.declare_discrete_state(vec({0.0, 0.0}));  // fired, and seen of the neighbour
    l.declare_output_port({.name = "fired",
                           .calc = [](const At& at) { return at.z[0]; },
                           .reads = Reads::discrete_state});
    l.declare_zero_crossing({.name = "fire",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state({0.0});
                                   next.set_discrete_state({at.z[0] + 1.0, at.z[1]});
                                 },
                             .direction = Direction::negative_then_non_negative});
    l.declare_zero_crossing({.name = "pushed",
                             .guard = [=](const At& at) { return at.u(in) - at.z[1] - 0.5; },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   next.set_continuous_state({at.x[0] + push});
                                   next.set_discrete_state({at.z[0], at.u(in)});
                                 },
                             .direction = Direction::negative_then_non_negative});
  });
}

/// A chain: neuron 0 sees nobody, neuron i the one before it.
Diagram chain(const std::vector<double>& v0) {
  DiagramBuilder builder;
  std::shared_ptr<const System> before = std::make_shared<Constant>("nobody", 0.0);
  builder.add(before);
  for (int i = 0; i < n; ++i) {
    const auto next = neuron(i, v0[static_cast<std::size_t>(i)]);
    builder.add(next);
    builder.connect(before->output(), next->input());
    before = next;
  }
  return builder.build();
}

}  // namespace

TEST_CASE("an avalanche goes down a chain of neurons in one instant", "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  // All within one push of the threshold when the first fires: each of the others is pushed over
  // it.
  const Diagram diagram = chain({0.5, 0.48, 0.47, 0.46, 0.45});
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 1.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  const auto times = results.events.times("fire");
  within("avalanche, first", method, times.empty() ? infinite : std::abs(times[0] - wait(0.5)),
         allowed(method, rtol, atol, 1.0) / 0.5);
  REQUIRE(times.size() == n);
  for (const double t : times) CHECK(t == times[0]);
  CHECK(results.events[results.events.size() - 1].jump == 2 * n - 1);
}

TEST_CASE("a chain of neurons out of step fires on the times of its closed form",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  const Diagram diagram = chain({0.5, 0.0, 0.0, 0.0, 0.0});
  const double rtol = 1e-9, atol = 1e-11;
  const double end = 3.5;  // after that all fire together, and a rounding decides who is pushed
  const auto results = simulate(diagram, diagram.create_context(), {0.0, end},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  // By hand: the next to reach its threshold fires; the one behind it is pushed, and may fire too.
  std::array<double, n> v{0.5, 0.0, 0.0, 0.0, 0.0};
  std::vector<double> expected;
  for (double t = 0.0;;) {
    const double dt = wait(std::ranges::max(v));
    if ((t += dt) > end) break;
    for (double& value : v) value = current - (current - value) * std::exp(-dt);
    std::array<bool, n> fires{};
    for (std::size_t i = 0; i < n; ++i) fires[i] = v[i] >= 1.0 - 1e-12;
    for (std::size_t i = 0; i < n; ++i) {
      const bool pushed = i > 0 && fires[i - 1];
      if (pushed && !fires[i]) v[i] += push, fires[i] = v[i] >= 1.0;
      if (fires[i]) v[i] = 0.0, expected.push_back(t);
    }
  }
  // The flow contracts; each of a dozen spikes errs by a location and its share of the flow,
  // over V' = 0.5, and hands that on.
  within("chain of neurons", method, worst(results.events.times("fire"), expected),
         static_cast<double>(expected.size()) * allowed(method, rtol, atol, 1.0) / 0.5);
}
