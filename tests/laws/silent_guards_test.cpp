// Guards that say only on which side they are: the looks at them follow what they read.
#include "support/cases.hpp"
#include "support/input_watcher.hpp"
#include "support/oscillator.hpp"
#include "support/sine.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double end = 100.0;

/// A guard of two values: +1 while the input is above the level.
std::shared_ptr<Leaf> truth(double level, bool counts) {
  return input_watcher("truth", [=](double u) { return u > level ? 1.0 : -1.0; }, counts);
}

/// sin(w t + 0.4) without a state, or beside one whose steps are about a second.
Diagram scene(double frequency, const std::shared_ptr<Leaf>& of, bool moves) {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{.frequency = frequency, .phase = 0.4});
  builder.add(of);
  builder.connect(sine.output(), of->input("u"));
  if (moves) builder.add(make_leaf("beside", [](Leaf& l) { declare_oscillator(l); }));
  return builder.build();
}

}  // namespace

TEST_CASE("every change of a truth is found where the signal that it reads varies",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double frequency = GENERATE(0.05, 1.0, 7.0), level = GENERATE(0.3, -0.9);
  const bool counts = GENERATE(true, false), moves = GENERATE(false, true);
  const Diagram diagram = scene(frequency, truth(level, counts), moves);
  const auto results = simulate(diagram, diagram.create_context(), {0.0, end},
                                {.ode_solver_method = method, .save_steps = false});
  // The slope at a crossing is w sqrt(1 - level^2); the angle has some roundings of w t.
  const double slope = frequency * std::sqrt(1.0 - level * level);
  within(text("silent guard ", frequency, " ", level, moves ? "" : ", no state"), method,
         worst(firing_times(results.events), sine_crossings(frequency, level, end)),
         8.0 * eps * (frequency * end) / slope + 200.0 * eps * end);
}

TEST_CASE("every change of a formula is found where it reads a function that is constant in pieces",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double level = GENERATE(0.3, -0.9);
  const bool formula = GENERATE(false, true);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{.phase = 0.4});
  auto& sign =
      formula
          ? builder.add<FunctionBlock>(
                "sign", Formula([=](const auto& at) { return 2.0 * (at.u(0) > level) - 1.0; }))
          : builder.add<FunctionBlock>("sign", [=](double u) { return u > level ? 1.0 : -1.0; });
  auto& port = builder.add<ControlPort>("port");
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(sine.output(), sign.input());
  builder.connect(sign.output(), port.input());
  builder.connect(port.output(), x.input());
  const Diagram diagram = builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, end},
                                {.ode_solver_method = method, .save_steps = false});
  within(text("formula behind a sign ", level, formula ? ", formula" : ""), method,
         worst(firing_times(results.events), sine_crossings(1.0, level, end)),
         8.0 * eps * end / std::sqrt(1.0 - level * level) + 200.0 * eps * end);
}

TEST_CASE("the time during which a function of a signal is true is the sum of its pieces",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double frequency = GENERATE(0.05, 1.0, 7.0), level = GENERATE(0.3, -0.9);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{.frequency = frequency, .phase = 0.4});
  auto& above = builder.add<FunctionBlock>("above", [=](double u) { return u > level; });
  auto& rate = builder.add<FunctionBlock>("rate", [](double truth) { return truth; });
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(sine.output(), above.input());
  builder.connect(above.output(), rate.input());
  builder.connect(rate.output(), x.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, end}, {.ode_solver_method = method});
  double true_for = 0.0, since = std::sin(0.4) > level ? 0.0 : end;
  const std::vector<double> times = sine_crossings(frequency, level, end);
  for (const double t : times) {
    const bool begins = std::cos(frequency * t + 0.4) > 0.0;
    if (!begins) true_for += t - since;
    since = begins ? t : end;
  }
  true_for += end - since;
  // Each piece begins and ends within some roundings of the time, and the sum is rounded.
  within(text("function of a sine ", frequency, " ", level), method,
         std::abs(results.context.continuous_state()[0] - true_for),
         static_cast<double>(times.size() + 1) * 200.0 * eps * end);
}

/// x = sin(t + 0.4) by a called function of the oscillator.
TEST_CASE("every change of a guard of two values is found where it reads the own state",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double level = GENERATE(0.5, 0.9, -0.9), rtol = GENERATE(1e-4, 1e-6, 1e-9);
  const bool formula = GENERATE(false, true);
  if (method == Method::taylor) return;  // it needs the series of the derivative
  const Leaf leaf("truth", [=](Leaf& l) {
    declare_oscillator(l, {std::sin(0.4), std::cos(0.4)});
    const auto side = [=](const auto& at) { return 2.0 * (at.x(0) > level) - 1.0; };
    const auto called = [=](const At& at) { return at.x[0] > level ? 1.0 : -1.0; };
    if (formula)
      l.declare_zero_crossing({.name = "hit", .formula = side});
    else
      l.declare_zero_crossing({.name = "hit", .guard = called});
  });
  const auto results = simulate(
      leaf, leaf.create_context(), {0.0, end},
      {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = method, .save_steps = false});
  // The amplitude is off by up to rtol t = 0.01: x stays above 0.9 for 0.85 s at least, and the last
  // of the crossings is 0.65 s before the end, the next one 0.65 s after it.
  CHECK(results.events.size() == sine_crossings(1.0, level, end).size());
}
