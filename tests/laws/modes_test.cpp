// Modes: a thermostat with two, integrate-and-fire with none, against closed forms.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double low = 19.0, high = 21.0, outside = 10.0, heated = 30.0, tau = 3.0;  // [degC], [s]
enum { off, on };

/// T' = (target - T) / tau; the heater goes on at `low` and off at `high`.
class Thermostat final : public LeafSystem {
 public:
  Thermostat() : LeafSystem("room") {
    declare_continuous_state({.initial = vec({20.0}), .ode = [](const At& at) {
                                return ((at.mode == on ? heated : outside) - at.x[0]) / tau;
                              }});
    declare_continuous_state_output("T");
    declare_mode_output("heater");
    declare_default_mode(on);
    declare_zero_crossing({.name = "cold",
                           .guard = [](const At& at) { return at.x[0] - low; },
                           .direction = Direction::positive_then_non_positive,
                           .start_mode = off,
                           .end_mode = on});
    declare_zero_crossing({.name = "warm",
                           .guard = [](const At& at) { return at.x[0] - high; },
                           .direction = Direction::negative_then_non_negative,
                           .start_mode = on,
                           .end_mode = off});
  }
};

}  // namespace

TEST_CASE("a thermostat switches when its closed form says", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Thermostat room;
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(room, room.create_context(), {0.0, 20.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  std::vector<double> exact{tau * std::log((heated - 20.0) / (heated - high))};
  const double cooling = tau * std::log((high - outside) / (low - outside));
  const double heating = tau * std::log((heated - low) / (heated - high));
  while (true) {
    const double next = exact.back() + (exact.size() % 2 == 1 ? cooling : heating);
    if (next > 20.0) break;
    exact.push_back(next);
  }
  REQUIRE(results.events.size() == exact.size());
  // A stable equation: at each switch T is wrong by 10 tolerances at most, that is a time of 1 / 3
  // s/degC, and the times add up.
  const double error = 10.0 * (rtol * high + atol) / 3.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    CHECK(results.events[i].name == (i % 2 == 0 ? "warm" : "cold"));
    CHECK_THAT(results.events[i].time, WithinAbs(exact[i], static_cast<double>(i + 1) * error));
  }
  CHECK(results.context.mode() == (exact.size() % 2 == 1 ? off : on));
}

TEST_CASE("integrate and fire: a leaky membrane spikes with the period of its closed form",
          "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // V' = (I - V) / tau, reset to 0 at 1: T = tau ln(I / (I - 1)).
  const double current = 1.5, tau_m = 0.02, period = tau_m * std::log(current / (current - 1.0));
  const Leaf neuron("neuron", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [&](const At& at) { return (current - at.x[0]) / tau_m; }});
    l.declare_zero_crossing(
        {.name = "spike",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::negative_then_non_negative});
  });
  const double rtol = 1e-9, atol = 1e-11;
  const auto results = simulate(neuron, neuron.create_context(), {0.0, 1.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  const auto spikes = results.events.times("spike");
  REQUIRE(spikes.size() == 45);
  // dV of 10 tolerances at the threshold, where V' = 25 / s, each period anew.
  for (std::size_t k = 0; k < spikes.size(); ++k) {
    const auto n = static_cast<double>(k + 1);
    CHECK_THAT(spikes[k], WithinAbs(n * period, n * 10.0 * (rtol + atol) / 25.0 * 3.0));
  }
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
}

TEST_CASE("a guard already beyond zero when its mode is entered waits until it has been back",
          "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x = sin t. Mode 0 ends at t = 1; the guard of mode 1, x falling through 0.5, is beyond zero
  // only after 5 pi / 6.
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return std::cos(at.time); }});
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "enter",
                             .guard = [](const At& at) { return at.time - 3.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "below",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 1,
                             .end_mode = 2});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 12.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  REQUIRE(results.events.size() == 2);
  CHECK_THAT(results.events[0].time, WithinAbs(3.0, 1e-12));
  // At t = 3 sin t < 0.5 already; next it falls through 0.5 at 2 pi + 5 pi / 6. Slope there 0.87.
  CHECK_THAT(results.events[1].time, WithinAbs(17.0 * std::acos(-1.0) / 6.0, 1e-7));
  CHECK(results.context.mode() == 2);
}

TEST_CASE("three modes in a circle: each guard is seen in its own mode only", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
    l.declare_default_mode(0);
    for (int m = 0; m < 3; ++m) {
      l.declare_zero_crossing(
          {.name = text("leave_", m),
           .guard = [](const At& at) { return std::sin(std::acos(-1.0) * at.time); },
           .start_mode = m,
           .end_mode = (m + 1) % 3});
    }
  });
  const auto results =
      simulate(leaf, leaf.create_context(0.5), {0.5, 7.5}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 7);
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(results.events[i].name == text("leave_", i % 3));
    CHECK_THAT(results.events[i].time, WithinAbs(static_cast<double>(i) + 1.0, 1e-10));
  }
}
