// Semantics 2.8 for guards that follow the time: the steps of a method say nothing of them.
#include <array>
#include <cmath>
#include <stdexcept>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr std::array all_methods{Method::dopri5, Method::dop853, Method::adams,    Method::bdf,
                                 Method::radau,  Method::taylor, Method::automatic};
constexpr double end = 6.0, frequency = 3.25, phase = 0.7, level = 0.85 / 1.9;

/// x' = 1 while 1.9 sin(3.25 t + 0.7) - 0.35 > 0.5.
Diagram sine_above_a_level() {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{1.9, frequency, phase, -0.35});
  auto& constant = builder.add<Constant>("level", 0.5);
  auto& above = builder.add<Comparator>("above", ">");
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(sine.output(), above.input(0));
  builder.connect(constant.output(), above.input(1));
  builder.connect(above.output(), x.input());
  return builder.build();
}

/// The same by a called guard. The clock s' = 1 is the second state: the guard throws where it is asked
/// for a time that does not belong to the state. The engine itself looks at most 1e-7 of the run beside
/// it. `refused` counts the exceptions.
std::shared_ptr<Leaf> strict_guard(const std::shared_ptr<int>& refused) {
  return make_leaf("leaf", [refused](Leaf& l) {
    l.declare_discrete_state(vec({std::sin(phase) > level ? 1.0 : 0.0}));
    l.declare_continuous_state({.initial = vec({0.0, 0.0}),
                                .ode = [](const At& at, VectorRef xdot) { xdot << at.z[0], 1.0; }});
    l.declare_zero_crossing(
        {.name = "change",
         .guard =
             [refused](const At& at) {
               if (std::abs(at.time - at.x[1]) > 1e-6 * end)
                 throw std::domain_error(text("not of this time ", ++*refused));
               return std::sin(frequency * at.time + phase) - level;
             },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state(vec({1.0 - at.z[0]})); }});
  });
}

const double pi = std::acos(-1.0);

/// The sine is above the level while its angle is in (a, pi - a), a = asin(0.85 / 1.9), and a turn or
/// more later: from the start on, twice for (pi - 2 a) / w, and from the fourth turn to the end.
double true_for() {
  const double a = std::asin(level);
  const double begun = pi - a - phase, whole = pi - 2.0 * a, last = a + 6.0 * pi - phase;
  return (begun + 2.0 * whole - last) / frequency + end;
}

}  // namespace

TEST_CASE("2.8 all crossings of a sine of time are found, though no state limits the steps",
          "[semantics]") {
  const auto method = GENERATE(from_range(all_methods));
  const Diagram diagram = sine_above_a_level();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, end}, {.ode_solver_method = method});
  INFO("method " << method);
  CHECK(firing_times(results.events).size() == 6);
  // Six crossings, each within the bracket of a root and the rounding of an angle of 20.
  CHECK_THAT(results.context.continuous_state()[0],
             Catch::Matchers::WithinAbs(true_for(), 6 * 200.0 * eps * end));
}

TEST_CASE("2.8 a called function need not stand a time that does not belong to the state",
          "[semantics]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::adams, Method::bdf,
                               Method::radau, Method::automatic);
  const auto refused = std::make_shared<int>(0);
  const auto leaf = strict_guard(refused);
  SimulatorOptions options;
  options.ode_solver_method = method;
  options.first_step = 1.0;  // the times are a part of a step apart
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, end}, options);
  INFO("method " << method << ": " << results.message);
  CHECK(*refused == 1);
  CHECK(results.status == Status::reached_end);
  CHECK(firing_times(results.events).size() == 6);
}
