// Discontinuities 1e-9 s apart, derivatives of 1e12.
#pragma once

#include "extremes/horizons.hpp"
#include "extremes/many.hpp"

namespace extremes {

namespace detail {

/// x' = -m, m turns at -width and +width: n switches.
inline Trial relay(double width, int n, double atol) {
  const auto leaf = make_leaf([width](Leaf& l) {
    l.declare_default_mode(1);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return -1.0 * at.mode; }});
    for (const int m : {1, -1})
      l.declare_zero_crossing({.name = m > 0 ? "low" : "high",
                               .guard = [=](const At& at) { return m * at.x[0] + width; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = m,
                               .end_mode = -m});
  });
  return trial(leaf, {0.0, 2.0 * width * n}, {.atol = atol},
               meets({.end = vec({0.0}),
                      .size = vec({width}),
                      .growth = static_cast<double>(n),
                      .times = spaced(width, 2.0 * width, n),
                      .events = true}));
}

/// x' = 0 until 0.5 s, then `rate` until x = 1: two changes of mode 1 / rate apart.
inline Trial pulse(double rate) {
  const auto leaf = make_leaf([rate](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [rate](const At& at) { return at.mode == 1 ? rate : 0.0; }});
    l.declare_zero_crossing({.name = "on",
                             .guard = [](const At& at) { return at.time - 0.5; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "off",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = 1,
                             .end_mode = 2});
  });
  // the change of x within the location error of a crossing, 100 eps t (semantics 2.9)
  return trial(leaf, {0.0, 1.0}, {.atol = 1e-8 + 100.0 * eps * 0.5 * rate},
               meets({.end = vec({1.0}), .times = {0.5, 0.5 + 1.0 / rate}, .events = true}));
}

/// x' = -1e12 (x - cos t) - sin t.
inline Trial pulled() {
  const auto leaf = make_leaf([](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                  return -1e12 * (at.x[0] - std::cos(at.time)) - std::sin(at.time);
                                }});
  });
  return trial(leaf, {0.0, 10.0}, {.rtol = 1e-6, .atol = 1e-6},
               meets({.end = vec({std::cos(10.0)}), .size = vec({1.0})}));
}

/// x' = 1e12 x (1 - x) from 1e-6: at 1/2 after log(1e6 - 1) / 1e12 s, then at rest.
/// Growth: the rise multiplies an early error by 1 / (4 x0), but the early x is small too: a
/// relative error r of x0 is one of the time r / 1e12; atol is 1e-4 of x0.
inline Trial logistic(double end) {
  const auto leaf = make_leaf([](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1e-6}), .ode = [](const At& at) {
                                  return 1e12 * at.x[0] * (1.0 - at.x[0]);
                                }});
    l.declare_zero_crossing({.name = "half",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .direction = Direction::negative_then_non_negative});
  });
  return trial(leaf, {0.0, end}, {.rtol = 1e-8, .atol = 1e-14},
               meets({.end = vec({1.0}),
                      .growth = 14.0,  // one for each factor e of the rise
                      .times = {std::log(999'999.0) / 1e12},
                      .events = true,
                      .speed = 0.25e12}));
}

}  // namespace detail

inline Group fast() {
  using namespace detail;
  const auto scene = [](std::string name, Methods methods, std::function<Trial()> make,
                        Expected expected = Expected::answer) {
    return Case{.name = std::move(name),
                .methods = std::move(methods),
                .trials = one(std::move(make)),
                .expected = expected};
  };
  return {
      .title = "Discontinuities 1e-9 s apart, derivatives of 1e12",
      .text = "",
      .cases = {
          scene("1000 updates 1e-9 s apart turn x' = z", every,
                [] { return updates(1000, 0.0, 1e-9); }),
          scene("1000 updates 1e-9 s apart turn x' = z, from t = 1 s", every,
                [] { return updates(1000, 1.0, 1e-9); }),
          scene("a relay that switches each 1e-9 s, 1000 times, atol = 1e-15", every,
                [] { return relay(0.5e-9, 1000, 1e-15); }),
          scene(
              "the same, atol = 1e-8, 20 times what it sees", every,
              [] { return relay(0.5e-9, 1000, 1e-8); }, Expected::either),
          ticking("100 monitors 1e-9 s apart", 0.0, 1e-9, false),
          ticking("100 resets 1e-9 s apart", 0.0, 1e-9, true),
          ticking("100 monitors 1e-9 s apart, from t = 1 s", 1.0, 1e-9, false),
          ticking("100 resets 1e-9 s apart, from t = 1 s", 1.0, 1e-9, true),
          scene("ball, y0 = 1e-18 m, e = 1: 1000 contacts 9e-10 s apart", every,
                [] {
                  return contacts_of({9.81, 1.0, 1e-18}, 1000,
                                     {.rtol = 1e-9, .atol = 1e-28, .zeno_tolerance = 1e-16});
                }),
          scene("a pulse of 1e9 for 1e-9 s", every, [] { return pulse(1e9); }),
          scene("a pulse of 1e12 for 1e-12 s", every, [] { return pulse(1e12); }),
          scene("x' = 1e12, monitors each 0.1 s", every,
                [] {
                  return trial(ramp(1e12, spaced(1e11, 1e11, 9), false), {0.0, 1.0}, {},
                               meets({.end = vec({1e12}),
                                      .times = spaced(0.1, 0.1, 9),
                                      .events = true,
                                      .speed = 1e12}));
                }),
          scene("x' = -1e12 (x - cos t) - sin t, 10 s", stiff_ones, [] { return pulled(); }),
          scene("x' = -1e12 x, 1e-11 s", every,
                [] {
                  return trial(decay(1e12, 1.0), {0.0, 1e-11}, {},
                               meets({.end = vec({std::exp(-10.0)}), .growth = 10.0}));
                }),
          scene("x' = 1e12 x (1 - x) from 1e-6, 5e-11 s", every, [] { return logistic(5e-11); }),
          scene("x' = 1e12 x (1 - x) from 1e-6, 1 s", stiff_ones, [] { return logistic(1.0); }),
      }};
}

}  // namespace extremes
