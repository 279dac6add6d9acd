// Horizons of 1e-12 s and 1e12 s, subnormal ones, and runs that begin at 1e9 s.
#pragma once

#include "extremes/balls.hpp"
#include "extremes/sizes.hpp"

namespace extremes {

namespace detail {

inline Case turning(std::string name, double w, TimeSpan span,
                    Expected expected = Expected::answer) {
  return {.name = std::move(name),
          .methods = every,
          .trials = one([=] {
            // Times are rounded: the turn within one rounding of t is unknown.
            const double blind = w * eps * std::max(std::abs(span.begin), std::abs(span.end));
            return trial(oscillator(w, 1.0), span, {.rtol = 1e-6, .atol = 1e-6 + blind},
                         turns(w, 1.0, span.end - span.begin));
          }),
          .expected = expected};
}

/// x' = 1 from t0, with monitors or resets every `step` seconds.
inline Case ticking(std::string name, double t0, double step, bool stop) {
  return {.name = std::move(name),
          .methods = every,
          .trials = one([=] {
            constexpr int n = 100;
            std::vector<double> times = spaced(t0 + step, step, n);
            const TimeSpan span{t0, t0 + (n + 0.5) * step};
            // x and t differ by t0 up to a rounding of t for each of the n restarts
            return trial(ramp(1.0, spaced(step, step, n), stop), span, {.atol = 1e-6 * step},
                         meets({.end = vec({span.end - t0}),
                                .growth = 1.0 + n * eps * t0 / (1e-6 * step),
                                .times = std::move(times),
                                .events = true}));
          })};
}

inline Case long_ramp(bool stop) {
  return {.name = text("x' = 1 for 1e12 s, ", stop ? "resets" : "monitors", " each 1e11 s"),
          .methods = every,
          .trials = one([stop] {
            return trial(
                ramp(1.0, spaced(1e11, 1e11, 9), stop), {0.0, 1e12}, {},
                meets({.end = vec({1e12}), .times = spaced(1e11, 1e11, 9), .events = true}));
          })};
}

}  // namespace detail

inline Group horizons() {
  using namespace detail;
  const auto slow_ball = [] { return to_rest({9.81e-24, 0.5, 1.0}, false); };
  return {
      .title = "Horizons",
      .text =
          "A scene whose clock runs 2^40 times faster or slower (2^-40 s = 9e-13 s, 2^40 s = 1e12 "
          "s) has to give the same bits.",
      .cases = {
          slower("oscillator", scaled_oscillator, -40, 2),
          slower("oscillator", scaled_oscillator, 40, 2),
          slower("thermostat", scaled_room, -40, 1),
          slower("thermostat", scaled_room, 40, 1),
          turning("x'' = -x for 1e-12 s", 1.0, {0.0, 1e-12}),
          turning("10 radians in 1e-12 s", 1e13, {0.0, 1e-12}),
          turning("10 radians in 1e12 s", 1e-11, {0.0, 1e12}),
          turning("10 radians in 1e-300 s", 1e301, {0.0, 1e-300}, Expected::either),
          turning("x'' = -x for 5e-320 s, all steps subnormal", 1.0, {0.0, 5e-320},
                  Expected::either),
          turning("10 radians in 1e-3 s, from t = 1e9 s", 1e4, {1e9, 1e9 + 1e-3}),
          turning("10 radians in 1e-5 s, 84 roundings of t, from t = 1e9 s", 1e6, {1e9, 1e9 + 1e-5},
                  Expected::either),
          long_ramp(false),
          long_ramp(true),
          ticking("100 monitors 1e-3 s apart, from t = 1e9 s", 1e9, 1e-3, false),
          ticking("100 resets 1e-3 s apart, from t = 1e9 s", 1e9, 1e-3, true),
          ticking("100 monitors 1e-6 s apart (8 roundings of t), from t = 1e9 s", 1e9, 1e-6, false),
          ticking("100 resets 1e-6 s apart (8 roundings of t), from t = 1e9 s", 1e9, 1e-6, true),
          {.name = "ball, g = 9.81e-24, to rest at 1.4e12 s",
           .methods = every,
           .trials = one(slow_ball)},
          {.name = "x' = -x from 1 for 1e12 s",
           .methods = stiff_ones,
           .trials = one(
               [] { return trial(decay(1.0, 1.0), {0.0, 1e12}, {}, meets({.end = vec({0.0})})); })},
          {.name = "x' = -1e-12 x from 1 for 1e12 s",
           .methods = every,
           .trials = one([] {
             return trial(decay(1e-12, 1.0), {0.0, 1e12}, {},
                          meets({.end = vec({std::exp(-1.0)})}));
           })},
      }};
}

}  // namespace extremes
