// Switched linear systems: a buck converter with pulse-width modulation, a room with a thermostat.
// References: products of matrix exponentials (references.py) and logarithms.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double vin = 12.0, inductance = 1e-3, capacity = 1e-4, resistance = 10.0;
constexpr double period = 1e-4, duty = 0.4;                               // [s], of the pulse
constexpr double low = 19.0, high = 21.0, outside = 10.0, heated = 30.0;  // [degC]

template <class Source>
void circuit(const At& at, VectorRef xdot, Source source) {
  xdot << (source * vin - at.x[1]) / inductance, (at.x[0] - at.x[1] / resistance) / capacity;
}

/// The switch is discrete state, written by two periodic updates; or a Pulse drives it.
std::vector<Form> bucks() {
  const auto alone = make_leaf("buck", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { circuit(at, xdot, at.z[0]); }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_periodic_update([](const At&, Next& next) { next.set_discrete_state({1.0}); },
                              period);
    l.declare_periodic_update([](const At&, Next& next) { next.set_discrete_state({0.0}); }, period,
                              duty * period);
  });
  const auto driven = make_leaf("buck", [](Leaf& l) {
    l.declare_input_port({.name = "switch", .shape = Shape::scalar()});
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { circuit(at, xdot, at.u(0)); }});
  });
  DiagramBuilder builder;
  builder.add(driven);
  auto& pulse = builder.add<Pulse>("pulse", PulseOptions{.period = period, .pulse_width = duty});
  builder.connect(pulse.output(), driven->input());
  return {{alone, "leaf"}, {std::make_shared<Diagram>(builder.build()), "diagram"}};
}

}  // namespace

TEST_CASE("a buck converter is where its matrix exponentials say", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  struct Reference {
    int periods;
    double i, v;
  };
  const std::array references{Reference{1, 0.46483502613624573, 0.36458909067126734},
                              Reference{10, 0.5564556687194742, 7.6990618263022641},
                              Reference{100, 0.33159698144521234, 4.7635706020172171},
                              Reference{500, 0.33571274222170797, 4.7948982358794905}};
  const double rtol = 1e-8, atol = 1e-10;
  for (const Form& form : bucks()) {
    for (const auto& [periods, i, v] : references) {
      const auto results = simulate(*form.system, form.context(), {0.0, periods * period},
                                    {.rtol = rtol, .atol = atol, .ode_solver_method = method});
      const auto& x = results.context.continuous_state();
      // i and v differ by the impedance sqrt(L / C) = 3.2 ohm: that is the growth. A transient
      // lasts 2 R C = 20 periods of two pieces each, whose errors add up.
      const double pieces = 2.0 * std::min(periods, 20);
      within(text("buck ", form.name), method, std::max(std::abs(x[0] - i), std::abs(x[1] - v)),
             pieces * allowed(method, rtol, atol, 8.0, 3.2));
    }
  }
}

TEST_CASE("a thermostat switches a thousand times, the last one on time", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const double tau = GENERATE(3.0, 1e5);  // [s]; with 1e5 the run is 1e8 s long
  const auto room = make_leaf("room", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({low}), .ode = [=](const At& at) {
                                  return ((at.mode == 1 ? heated : outside) - at.x[0]) / tau;
                                }});
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "warm",
                             .guard = [](const At& at) { return at.x[0] - high; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = 1,
                             .end_mode = 0});
    l.declare_zero_crossing({.name = "cold",
                             .guard = [](const At& at) { return at.x[0] - low; },
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 0,
                             .end_mode = 1});
  });
  const double heating = tau * std::log((heated - low) / (heated - high)),
               cooling = tau * std::log((high - outside) / (low - outside));
  std::vector<double> expected{heating};
  while (expected.size() < 1000)
    expected.push_back(expected.back() + (expected.size() % 2 == 1 ? cooling : heating));
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : forms(room)) {
    const auto results =
        simulate(*form.system, form.context(), {0.0, expected.back() + 0.5 * cooling},
                 {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Each piece starts anew from its level; an error dT is a time tau dT / 9, and they add up.
    const double once =
        tau * allowed(method, rtol, atol, high) / 9.0 + 200.0 * eps * expected.back();
    within(text("thermostat tau=", tau, " ", form.name), method,
           worst(firing_times(results.events), expected), 1000.0 * once);
  }
}
