// States of 1e-300 and 1e300, alone and together; guards of any size.
#pragma once

#include "extremes/scenes.hpp"

namespace extremes {

namespace detail {

/// Two oscillations over ten radians; times scaled by 2^time, states by 2^size.
inline Trial scaled_oscillator(int time, int size) {
  const double t = std::ldexp(1.0, time), x = std::ldexp(1.0, size);
  return trial(oscillator(1.0 / t, x), {0.0, 10.0 * t}, {.rtol = 1e-6, .atol = 1e-8 * x});
}

/// A ball's first bounces; heights and gravity scaled.
inline Trial scaled_ball(int, int size) {
  const double y = std::ldexp(1.0, size);
  return trial(Ball{.g = 9.81 * y, .e = 0.75, .y0 = y}.leaf(), {0.0, 2.0},
               {.rtol = 1e-6, .atol = 1e-8 * y});
}

/// A room between 19 and 21 degrees, 8 s of it: one state, so that times scale alone.
inline Trial scaled_room(int time, int size) {
  const double t = std::ldexp(1.0, time), x = std::ldexp(1.0, size);
  const auto room = make_leaf([=](Leaf& l) {
    l.declare_default_mode(1);
    l.declare_continuous_state({.initial = vec({20.0 * x}), .ode = [=](const At& at) {
                                  return ((at.mode == 1 ? 30.0 * x : 10.0 * x) - at.x[0]) / t;
                                }});
    for (const int mode : {0, 1})
      l.declare_zero_crossing({.name = mode == 1 ? "warm" : "cold",
                               .guard =
                                   [=](const At& at) {
                                     return (mode == 1 ? 1.0 : -1.0) *
                                            (at.x[0] - (19.0 + 2 * mode) * x);
                                   },
                               .direction = Direction::negative_then_non_negative,
                               .start_mode = mode,
                               .end_mode = 1 - mode});
  });
  return trial(room, {0.0, 8.0 * t}, {.rtol = 1e-6, .atol = 1e-8 * x, .zeno_tolerance = 1e-6 * t});
}

inline Case to_the_bit(std::string name, Trial (*make)(int, int), int time, int size,
                       std::vector<int> states) {
  return {.name = std::move(name), .methods = every, .trials = one([=] {
                                                       Trial scaled = make(time, size);
                                                       scaled.law =
                                                           scales([make] { return make(0, 0); },
                                                                  time, states);
                                                       return scaled;
                                                     })};
}
inline Case larger(const std::string& what, Trial (*make)(int, int), int size, std::size_t n) {
  return to_the_bit(text(what, ", states times 2^", size, ", to the bit"), make, 0, size,
                    std::vector<int>(n, size));
}
inline Case slower(const std::string& what, Trial (*make)(int, int), int time, std::size_t n) {
  return to_the_bit(text(what, ", times multiplied by 2^", time, ", to the bit"), make, time, 0,
                    std::vector<int>(n, 0));
}

inline Case oscillating(double size) {
  return {.name = text("x'' = -x, 10 s, amplitude ", size),
          .methods = every,
          .trials = one([size] {
            return trial(oscillator(1.0, size), {0.0, 10.0}, {.rtol = 1e-6, .atol = 1e-8 * size},
                         turns(1.0, size, 10.0));
          })};
}

/// Relative errors of a decay are not damped: the errors of all time constants add up.
inline Case decaying(std::string name, double from, double span, double atol,
                     Expected expected = Expected::answer, bool quick = true) {
  return {.name = std::move(name),
          .methods = every,
          .trials = one([=] {
            return trial(decay(1.0, from), {0.0, span}, {.rtol = 1e-6, .atol = atol},
                         meets({.end = vec({from * std::exp(-span)}), .growth = span}));
          }),
          .expected = expected,
          .quick = quick};
}

/// Two decays of different size; the small one must be as accurate as the large one.
inline Case together(double large, double small, Methods methods) {
  return {.name = text("x' = -x from ", large, " beside x' = -2 x from ", small),
          .methods = std::move(methods),
          .trials = one([=] {
            const auto both = make_leaf([=](Leaf& l) {
              l.declare_continuous_state(
                  {.initial = vec({large, small}),
                   .ode = [](const At& at, VectorRef d) { d << -at.x[0], -2.0 * at.x[1]; }});
            });
            return trial(both, {0.0, 5.0}, {.rtol = 1e-6, .atol = 1e-9 * small},
                         meets({.end = vec({large * std::exp(-5.0), small * std::exp(-10.0)}),
                                .growth = 10.0}));
          })};
}

/// A ramp that is stopped at 1/3 and 2/3; the guards have their own unit.
inline Case guards_of_size(double unit) {
  return {.name = text("a guard multiplied by ", unit),
          .methods = every,
          .trials = one([unit] {
            const auto leaf = make_leaf([unit](Leaf& l) {
              l.declare_continuous_state(
                  {.initial = vec({1.0, 0.0}),
                   .ode = [](const At& at, VectorRef d) { d << at.x[1], -at.x[0]; }});
              l.declare_zero_crossing(
                  {.name = "zero",
                   .guard = [unit](const At& at) { return unit * at.x[0]; },
                   .reset_map = [](const At& at, Next& next) { next.set_continuous_state(at.x); }});
            });
            constexpr double pi = std::numbers::pi;
            return trial(leaf, {0.0, 10.0}, {.rtol = 1e-9, .atol = 1e-11},
                         meets({.end = vec({std::cos(10.0), -std::sin(10.0)}),
                                .size = vec({1.0, 1.0}),
                                .growth = 10.0,
                                .times = {0.5 * pi, 1.5 * pi, 2.5 * pi},
                                .events = true}));
          })};
}

}  // namespace detail

inline Group sizes_of_states() {
  using namespace detail;
  return {
      .title = "States of 1e-300 and 1e300",
      .text = "",
      .cases = {
          larger("oscillator", scaled_oscillator, 900, 2),
          larger("oscillator", scaled_oscillator, -900, 2),
          larger("thermostat", scaled_room, 900, 1),
          larger("thermostat", scaled_room, -900, 1),
          larger("ball, e = 0.75", scaled_ball, 400, 2),
          larger("ball, e = 0.75", scaled_ball, -400, 2),
          larger("ball, e = 0.75", scaled_ball, 900, 2),
          larger("ball, e = 0.75", scaled_ball, -900, 2),
          oscillating(1e300),
          oscillating(1e-300),
          decaying("x' = -x from 1e300, 20 s", 1e300, 20.0, 1e285),
          decaying("x' = -x from 1e-300, 20 s, atol = 1e-315", 1e-300, 20.0, 1e-315,
                   Expected::either, false),
          decaying("x' = -x from 1e-300 into the subnormals, 40 s", 1e-300, 40.0, 1e-320,
                   Expected::either, false),
          decaying("x' = -x from 1e300 to 1e-6, 706 s", 1e300, 706.0, 1e-9),
          together(1e12, 1e-12, every),
          together(1e150, 1e-150, every),
          {.name = "x' = x from 1e300 beyond the largest double, at 18.974 s",
           .methods = every,
           .trials = one([] { return trial(decay(-1.0, 1e300), {0.0, 50.0}, {.atol = 1e290}); }),
           .expected = Expected::error,
           .error_says = "t = "},
          guards_of_size(1e-300),
          guards_of_size(1e300),
      }};
}

}  // namespace extremes
