// Tolerances from 1e-2 to 1e-15, and impossible tolerances.
#pragma once

#include "extremes/scenes.hpp"

namespace extremes {

namespace detail {

/// A turn of an oscillator with a reset at each zero that changes nothing.
inline Case at_tolerance(double rtol) {
  return {.name = text("x'' = -x, 10 s, three resets, rtol = atol = ", rtol),
          .methods = every,
          .trials = one([rtol] {
            const auto leaf = make_leaf([](Leaf& l) {
              l.declare_continuous_state(
                  {.initial = vec({1.0, 0.0}),
                   .ode = [](const At& at, VectorRef d) { d << at.x[1], -at.x[0]; }});
              l.declare_zero_crossing(
                  {.name = "zero",
                   .guard = [](const At& at) { return at.x[0]; },
                   .reset_map = [](const At& at, Next& next) { next.set_continuous_state(at.x); }});
            });
            constexpr double pi = std::numbers::pi;
            return trial(leaf, {0.0, 10.0}, {.rtol = rtol, .atol = rtol},
                         meets({.end = vec({std::cos(10.0), -std::sin(10.0)}),
                                .size = vec({1.0, 1.0}),
                                .growth = 10.0,
                                .times = {0.5 * pi, 1.5 * pi, 2.5 * pi},
                                .events = true}));
          }),
          .expected = rtol < 1e-13 ? Expected::either : Expected::answer};
}

/// A. Prothero and A. Robinson, Math. Comp. 28 (1974), p. 145: x' = -1e6 (x - cos t) - sin t.
inline Case stiff_at(double rtol) {
  return {.name = text("x' = -1e6 (x - cos t) - sin t, 10 s, rtol = atol = ", rtol),
          .methods = stiff_ones,
          .trials = one([rtol] {
            const auto leaf = make_leaf([](Leaf& l) {
              l.declare_continuous_state({.initial = vec({1.0}), .ode = [](const At& at) {
                                            return -1e6 * (at.x[0] - std::cos(at.time)) -
                                                   std::sin(at.time);
                                          }});
            });
            return trial(leaf, {0.0, 10.0}, {.rtol = rtol, .atol = rtol},
                         meets({.end = vec({std::cos(10.0)}), .size = vec({1.0})}));
          }),
          .expected = rtol < 1e-13 ? Expected::either : Expected::answer};
}

inline Case refused(std::string name, double rtol, double atol, std::string says) {
  return {.name = std::move(name),
          .methods = every,
          .trials = one([=] {
            return trial(oscillator(1.0, 1.0), {0.0, 10.0}, {.rtol = rtol, .atol = atol});
          }),
          .expected = Expected::error,
          .error_says = std::move(says)};
}

}  // namespace detail

inline Group tolerances() {
  using namespace detail;
  Group group{.title = "Tolerances",
              .text = "From 1e-14 on a clear error is as good as an answer: a state has 16 digits.",
              .cases = {}};
  for (const double rtol : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15})
    group.cases.push_back(at_tolerance(rtol));
  for (const double rtol : {1e-2, 1e-6, 1e-10, 1e-13, 1e-15}) group.cases.push_back(stiff_at(rtol));
  group.cases.push_back(refused("rtol = 1e-16", 1e-16, 1e-8, "rtol"));
  group.cases.push_back(refused("rtol = 0", 0.0, 1e-8, "rtol"));
  group.cases.push_back(refused("atol = 0", 1e-6, 0.0, "atol"));
  group.cases.push_back(refused("atol = NaN", 1e-6, std::nan(""), "atol"));
  return group;
}

}  // namespace extremes
