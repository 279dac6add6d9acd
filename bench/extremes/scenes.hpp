// The scenes that several groups use with extreme values.
#pragma once

#include <numbers>

#include "extremes/laws.hpp"

namespace extremes {

/// x0' = w x1, x1' = -w x0, from (size, 0): cosine and sine.
inline std::shared_ptr<const System> oscillator(double w, double size) {
  return make_leaf([=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({size, 0.0}), .ode = [w](const At& at, VectorRef d) {
                                  d << w * at.x[1], -w * at.x[0];
                                }});
  });
}

/// Over `span` seconds. A local error is neither damped nor amplified; the errors of all radians
/// add up.
inline Law turns(double w, double size, double span) {
  return meets({.end = vec({size * std::cos(w * span), -size * std::sin(w * span)}),
                .size = vec({size, size}),
                .growth = std::max(1.0, w * span)});
}

/// x' = -rate x from x0.
inline std::shared_ptr<const System> decay(double rate, double x0) {
  return make_leaf([=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({x0}), .ode = [rate](const At& at) { return -rate * at.x[0]; }});
  });
}

/// x' = rate; guard `x - level` for each level, as monitors or, with `stop`, as resets that write
/// the same value.
inline std::shared_ptr<const System> ramp(double rate, std::vector<double> levels, bool stop) {
  return make_leaf([=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [rate](const At&) { return rate; }});
    saltus::ZeroCrossing crossing{.name = "level",
                                  .guard =
                                      [levels](const At& at, VectorRef g) {
                                        for (std::size_t i = 0; i < levels.size(); ++i)
                                          g[static_cast<Index>(i)] = at.x[0] - levels[i];
                                      },
                                  .direction = Direction::negative_then_non_negative,
                                  .size = static_cast<Index>(levels.size())};
    if (stop)
      crossing.reset_map = [](const At& at, Next& next) { next.set_continuous_state(at.x); };
    l.declare_zero_crossing(std::move(crossing));
  });
}

/// n values, first + k step.
inline std::vector<double> spaced(double first, double step, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(first + k * step);
  return values;
}

/// A ball over a floor at 0, dropped from y0 [m].
struct Ball {
  double g = 9.81, e = 0.5, y0 = 1.0;

  double first() const { return std::sqrt(2.0 * y0 / g); }         ///< [s] of contact 1
  double speed() const { return std::sqrt(2.0 * y0 * g); }         ///< [m/s] at contact 1
  double rest() const { return first() * (1.0 + e) / (1.0 - e); }  ///< [s] Zeno time
  /// The contacts until `end`, in extended precision.
  std::vector<double> contacts(double end) const {
    std::vector<double> times;
    long double t = std::sqrt(2.0L * y0 / g), flight = 2.0L * t;
    for (; t <= end; t += flight) {
      times.push_back(static_cast<double>(t));
      flight *= e;
      if (flight == 0.0L) break;  // e = 0: one contact
    }
    return times;
  }
  std::shared_ptr<const System> leaf() const {
    return make_leaf([g = g, e = e, y0 = y0](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({y0, 0.0}), .ode = [g](const At& at, VectorRef d) { d << at.x[1], -g; }});
      l.declare_zero_crossing(
          {.name = "bounce",
           .guard = [](const At& at) { return at.x[0]; },
           .reset_map = [e](const At& at,
                            Next& next) { next.set_continuous_state({0.0, -e * at.x[1]}); },
           .direction = Direction::positive_then_non_positive});
    });
  }
};

/// About n contacts of a ball that loses little or nothing. An impact wrong by one tolerance delays
/// all later ones: they add up as n^2.
inline Trial contacts_of(const Ball& ball, int n, const SimulatorOptions& options) {
  const double end = 2.0 * ball.first() * n;
  return trial(ball.leaf(), {0.0, end}, options,
               meets({.size = vec({ball.y0, ball.speed()}),
                      .growth = 4.0,
                      .times = ball.contacts(end),
                      .events = true,
                      .speed = ball.speed(),
                      .power = 2.0}));
}

}  // namespace extremes
