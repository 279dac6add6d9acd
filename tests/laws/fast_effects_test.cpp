// Guards with effects that turn while the states hardly move: after each firing the flow decides the side of
// the guard, and it has to be looked at before the guard turns.
#include <stdexcept>

#include "support/cases.hpp"
#include "support/sine.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double end = 40.0, phase = 0.4;

/// x' = rate from 1, and c' = 1 from `clock`. The guard is sin(frequency s + 0.4), where s is the time or
/// c - clock, and its effect counts.
struct Scene {
  double frequency, rate, clock;
  bool by_state, called, up;

  std::shared_ptr<Leaf> make() const {
    return make_leaf("leaf", [*this](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, clock}),
           .ode = [r = rate](const At&, VectorRef xdot) { xdot[0] = r, xdot[1] = 1.0; }});
      l.declare_discrete_state(vec({0.0}));
      ZeroCrossing hit{.name = "hit", .reset_map = ResetMap(count_up)};
      if (up) hit.direction = Direction::negative_then_non_negative;
      if (called)
        hit.guard = [*this](const At& at) {
          return std::sin(frequency * (by_state ? at.x[1] - clock : at.time) + phase);
        };
      else
        hit.formula = Formula([*this](const auto& at) {
          return sin((by_state ? at.x(1) - clock : at.time() + 0.0) * frequency + phase);
        });
      l.declare_zero_crossing(hit);
    });
  }
  /// The times at which the sine is zero, those where it rises or all.
  std::vector<double> crossings() const {
    std::vector<double> times;
    for (int k = 1; (k * std::numbers::pi - phase) / frequency < end; ++k)
      if (!up || k % 2 == 0) times.push_back((k * std::numbers::pi - phase) / frequency);
    return times;
  }
};

}  // namespace

TEST_CASE("each firing of a guard that turns while the states hardly move is found",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool by_state = GENERATE(false, true), called = GENERATE(false, true),
             up = GENERATE(false, true);
  if (by_state && called) return;  // nobody knows what such a function turns by
  for (const double frequency : {21.3, 57.0, 118.7}) {
    for (const double rtol : {1e-2, 1e-3, 1e-6}) {
      const Scene scene{frequency, 0.02, by_state ? 1000.0 : 0.0, by_state, called, up};
      const auto leaf = scene.make();
      const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                    {.rtol = rtol, .ode_solver_method = method});
      // The time and the clock have a rounding each, of `end` or of the clock, and a step adds one more.
      within(text("fast effect ", frequency, " ", rtol, by_state ? " state" : "",
                  called ? " called" : ""),
             method, worst(firing_times(results.events), scene.crossings()),
             by_state ? 1e-9 : 200.0 * eps * end);
      CHECK(results.context.discrete_state()[0] == static_cast<double>(scene.crossings().size()));
    }
  }
}

/// x' = 1 from a thousandth, so that x - t is a thousandth along the flow. The guard has no value where x is
/// less than the time, as it is at a later time with the same state.
TEST_CASE("a called guard may refuse a state that does not belong to the time", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-2, 1e-3, 1e-6), apart = 1e-3;
  const auto leaf = make_leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 1.0, apart);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard =
                                 [](const At& at) {
                                   if (at.x[0] < at.time) throw std::domain_error("x < t");
                                   return std::sin(5.0 * at.time + phase);
                                 },
                             .reset_map = count_up});
  });
  const auto results = simulate(*leaf, leaf->create_context(), {0.0, 10.0},
                                {.rtol = rtol, .ode_solver_method = method});
  within(text("guard that refuses ", rtol), method,
         worst(firing_times(results.events), sine_crossings(5.0, 0.0, 10.0)), 200.0 * eps * 10.0);
}
