// Dry friction as modes. A mass on a belt, held by a spring: it sticks until the spring pulls with
// Fs, slips with Fk < Fs until its speed is the belt's again. And a mass that slides to a stop.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

enum { stick, slip };
constexpr double belt = 0.1, fs = 1.0, fk = 0.6;  // m = k = 1: natural frequency 1

/// `looks`: the direction of "sticks". Its guard stands at zero when `slip` is entered.
std::shared_ptr<Leaf> mass_on_belt(Direction looks) {
  return make_leaf("mass", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, belt}), .ode = [](const At& at, VectorRef xdot) {
           xdot << at.x[1], at.mode == stick ? 0.0 : fk - at.x[0];
         }});
    l.declare_default_mode(stick);
    l.declare_zero_crossing({.name = "slips",
                             .guard = [](const At& at) { return at.x[0] - fs; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = stick,
                             .end_mode = slip});
    l.declare_zero_crossing(
        {.name = "sticks",
         .guard = [](const At& at) { return at.x[1] - belt; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.x[0], belt}); },
         .direction = looks,
         .start_mode = slip,
         .end_mode = stick});
  });
}

/// A mass thrown with v0 that Coulomb friction f brings to rest at v0 / f; on from `push` it is
/// pushed again.
std::shared_ptr<Leaf> sliding_mass(double v0, double f, double push) {
  return make_leaf("mass", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, v0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], at.mode == slip ? -f : 0.0;
         }});
    l.declare_default_mode(slip);
    l.declare_zero_crossing(
        {.name = "stops",
         .guard = [](const At& at) { return at.x[1]; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.x[0], 0.0}); },
         .direction = Direction::positive_then_non_positive,
         .start_mode = slip,
         .end_mode = stick});
    l.declare_periodic_update(
        [=](const At& at, Next& next) {
          next.set_continuous_state({at.x[0], v0});
          next.set_mode(slip);
        },
        push, push, "push");
  });
}

}  // namespace

TEST_CASE("stick and slip have the periods of their closed form", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const Direction looks = GENERATE(Direction::negative_then_non_negative, Direction::crosses_zero);
  const double rtol = 1e-9, atol = 1e-11;
  for (const Form& form : forms(mass_on_belt(looks))) {
    // Slip: x = fk + a cos t + belt sin t from x = fs, v = belt; v = belt again after
    // 2 (pi - atan(a / belt)), at x = fk - a. Stick: 2 a / belt.
    const double a = fs - fk, slipping = 2.0 * (std::acos(-1.0) - std::atan(a / belt));
    const int n = 40;
    std::vector<double> expected{fs / belt};
    for (int k = 1; k < n; ++k)
      expected.push_back(expected.back() + (k % 2 == 1 ? slipping : 2.0 * a / belt));
    const auto results = simulate(*form.system, form.context(), {0.0, expected.back() + 1.0},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // Each slip starts anew, from x = fs to the location's error. Its error of x is one of time of
    // 1 / belt, and of v, where it sticks with the acceleration fk - x = a, of 1 / a: 12.5
    // together. A slip is 3.6 s of an oscillator of growth 1.
    within(text("stick-slip ", to_string(looks), " ", form.name), method,
           worst(firing_times(results.events), expected),
           n * 12.5 * allowed(method, rtol, atol, fs, 3.6));
  }
}

TEST_CASE("a mass that friction stops stays, and slides again when pushed", "[laws][modes]") {
  const auto method = GENERATE(from_range(methods));
  const double v0 = GENERATE(1.0, 1e-3);
  const double f = GENERATE(0.7, 20.0);
  for (const Form& form : forms(sliding_mass(v0, f, 3.0))) {
    const double rtol = 1e-9, atol = 1e-12;
    const auto results = simulate(*form.system, form.context(), {0.0, 8.9},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // A line and a parabola: three slides, each 40 steps of a multistep method.
    const double made = one_step(method) ? 0.0 : 40.0 * (rtol * v0 + atol);
    within(text("friction stops ", form.name), method,
           worst(firing_times(results.events), {v0 / f, 3.0 + v0 / f, 6.0 + v0 / f}),
           made / f + 200.0 * eps * 9.0);
    const auto& x = results.context.continuous_state();
    within(text("friction path ", form.name), method, std::abs(x[0] - 3.0 * 0.5 * v0 * v0 / f),
           3.0 * (made * (1.0 + v0 / f) + v0 * 200.0 * eps * 9.0));
    CHECK(x[1] == 0.0);
  }
}
