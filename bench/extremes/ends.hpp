// Where solutions end: blow-up in finite time, and boundaries beyond which nothing is defined.
#pragma once

#include "extremes/scenes.hpp"

namespace extremes {

namespace detail {

using Derivative = double (*)(double t, double x);

inline std::shared_ptr<const System> scalar(Derivative f, double x0) {
  return make_leaf([=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({x0}), .ode = [f](const At& at) { return f(at.time, at.x[0]); }});
  });
}

inline Case ends_at(std::string name, Derivative f, double x0, double time) {
  return {.name = std::move(name),
          .methods = every,
          .trials = one([=] {
            return trial(scalar(f, x0), {0.0, 2.0 * time}, {.atol = x0 > 0.0 ? 1e-8 * x0 : 1e-8});
          }),
          .expected = Expected::error,
          .error_says = "t = ",
          .error_time = time};
}

/// x' = x^2 from 1, reset to 1 at `level`, which it reaches after 1 - 1 / level.
inline Trial caught(double level) {
  const auto leaf = make_leaf([level](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [](const At& at) { return at.x[0] * at.x[0]; }});
    l.declare_zero_crossing(
        {.name = "caught",
         .guard = [level](const At& at) { return at.x[0] - level; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({1.0}); },
         .direction = Direction::negative_then_non_negative});
  });
  // A relative error r of x is an error of the time of r / x <= r; a location error is an error of
  // x of 100 eps x^2.
  const double lap = 1.0 - 1.0 / level;
  return trial(leaf, {0.0, 3.5 * lap}, {},
               meets({.end = vec({1.0 / (1.0 - 0.5 * lap)}),
                      .growth = 12.0,
                      .times = {lap, 2.0 * lap, 3.0 * lap},
                      .events = true}));
}

/// A leaf that is defined for x >= 0 only, and a mode that ends at 0.
inline Trial to_boundary(Derivative f, double x0, double time, bool guard) {
  const auto leaf = make_leaf([=](Leaf& l) {
    l.declare_default_mode(0);
    l.declare_continuous_state({.initial = vec({x0}), .ode = [f](const At& at) {
                                  return at.mode == 0 ? f(at.time, at.x[0]) : 0.0;
                                }});
    if (guard)
      l.declare_zero_crossing({.name = "empty",
                               .guard = [](const At& at) { return at.x[0]; },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = 0,
                               .end_mode = 1});
  });
  return trial(leaf, {0.0, 2.0 * time}, {},
               meets({.end = vec({0.0}), .size = vec({x0}), .times = {time}, .events = true}));
}

inline double nan_below(double, double x) { return x >= 0.0 ? -1.0 : std::nan(""); }
inline double root_below(double, double x) { return -1.0 - std::sqrt(x); }

inline Case bounded(std::string name, Derivative f, double x0, double time) {
  return {.name = std::move(name) + ", a guard there",
          .methods = every,
          .trials = one([=] { return to_boundary(f, x0, time, true); })};
}
inline Case unbounded(std::string name, Derivative f, double x0, double time) {
  return {.name = std::move(name) + ", no guard",
          .methods = every,
          .trials = one([=] { return to_boundary(f, x0, time, false); }),
          .expected = Expected::error,
          .error_says = "not finite",
          .error_time = time};
}

}  // namespace detail

inline Group ends() {
  using namespace detail;
  const auto square = [](double, double x) { return x * x; };
  return {
      .title = "Where solutions end",
      .text = "An error has to come within a thousandth of the time at which the solution ends.",
      .cases = {
          ends_at("x' = x^2 from 1, ends at 1 s", square, 1.0, 1.0),
          ends_at("x' = x^2 from 1e-9, ends at 1e9 s", square, 1e-9, 1e9),
          ends_at("x' = x^2 from 1e9, ends at 1e-9 s", square, 1e9, 1e-9),
          ends_at(
              "x' = x^3 from 1, ends at 0.5 s", [](double, double x) { return x * x * x; }, 1.0,
              0.5),
          ends_at(
              "x' = 1 + x^2 from 0, ends at pi/2 s", [](double, double x) { return 1.0 + x * x; },
              0.0, 0.5 * std::numbers::pi),
          ends_at(
              "x' = exp(x) from 0, ends at 1 s", [](double, double x) { return std::exp(x); }, 0.0,
              1.0),
          ends_at(
              "x' = x^1.1 from 1, ends at 10 s",
              [](double, double x) { return std::pow(std::abs(x), 1.1); }, 1.0, 10.0),
          ends_at(
              "x' = -1/x from 1, ends at 0.5 s", [](double, double x) { return -1.0 / x; }, 1.0,
              0.5),
          ends_at(
              "x' = -1/x^3 from 1, ends at 0.25 s",
              [](double, double x) { return -1.0 / (x * x * x); }, 1.0, 0.25),
          ends_at(
              "x' = 1/(1 - t), ends at 1 s", [](double t, double) { return 1.0 / (1.0 - t); }, 0.0,
              1.0),
          ends_at(
              "x' = 1/(1 - t)^2, ends at 1 s",
              [](double t, double) { return 1.0 / ((1.0 - t) * (1.0 - t)); }, 1.0, 1.0),
          {.name = "x' = x^2 from 1, back to 1 at 1e3, three times",
           .methods = every,
           .trials = one([] { return caught(1e3); })},
          {.name = "x' = x^2 from 1, back to 1 at 1e12, three times",
           .methods = every,
           .trials = one([] { return caught(1e12); })},
          {.name = "x' = x^2 from -1 for 1e6 s",
           .methods = every,
           .trials = one([square] {
             return trial(scalar(square, -1.0), {0.0, 1e6}, {.atol = 1e-12},
                          meets({.end = vec({-1.0 / 1'000'001.0})}));
           })},
          bounded("x' = -1, NaN below 0", nan_below, 1.0, 1.0),
          bounded("x' = -1 - sqrt(x), NaN below 0", root_below, 1.0, 2.0 * (1.0 - std::log(2.0))),
          unbounded("x' = -1, NaN below 0", nan_below, 1.0, 1.0),
          unbounded("x' = -1 - sqrt(x), NaN below 0", root_below, 1.0, 2.0 * (1.0 - std::log(2.0))),
          unbounded("x' = -1, NaN below 0, from 1e9", nan_below, 1e9, 1e9),
      }};
}

}  // namespace extremes
