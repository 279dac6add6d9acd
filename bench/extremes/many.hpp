// Many states, many blocks, many guards, many events.
#pragma once

#include "extremes/scenes.hpp"

namespace extremes {

namespace detail {

/// Oscillator i of n turns at 1 + i / n.
inline double rate(Index i, Index n) {
  return 1.0 + static_cast<double>(i) / static_cast<double>(n);
}

inline Eigen::VectorXd turned(Index n, double t) {
  Eigen::VectorXd x(2 * n);
  for (Index i = 0; i < n; ++i)
    x.segment(2 * i, 2) << std::cos(rate(i, n) * t), -std::sin(rate(i, n) * t);
  return x;
}

inline std::shared_ptr<const System> oscillators(Index n) {
  return make_leaf([n](Leaf& l) {
    l.declare_continuous_state({.initial = turned(n, 0.0), .ode = [n](const At& at, VectorRef d) {
                                  for (Index i = 0; i < n; ++i) {
                                    d[2 * i] = rate(i, n) * at.x[2 * i + 1];
                                    d[2 * i + 1] = -rate(i, n) * at.x[2 * i];
                                  }
                                }});
    std::vector<saltus::MatrixEntry> entries;
    for (int i = 0; i < 2 * n; i += 2) entries.push_back({i, i + 1}), entries.push_back({i + 1, i});
    l.declare_jacobian_sparsity(std::move(entries));
  });
}

template <class Declare>
std::shared_ptr<const System> of_leaves(Index n, Declare declare) {
  saltus::DiagramBuilder builder;
  for (Index i = 0; i < n; ++i)
    builder.add(std::make_shared<const Leaf>(text("leaf ", i), [&](Leaf& l) { declare(l, i); }));
  return std::make_shared<const saltus::Diagram>(builder.build());
}

inline std::shared_ptr<const System> oscillator_leaves(Index n) {
  return of_leaves(n, [n](Leaf& l, Index i) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [w = rate(i, n)](const At& at, VectorRef d) { d << w * at.x[1], -w * at.x[0]; }});
  });
}

/// Each leaf has two states, which follow cos t and sin t at 1e6 / s.
inline std::shared_ptr<const System> stiff_leaves(Index n) {
  return of_leaves(n, [](Leaf& l, Index) {
    l.declare_continuous_state({.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef d) {
                                  const double c = std::cos(at.time), s = std::sin(at.time);
                                  d << -1e6 * (at.x[0] - c) - s, -1e6 * (at.x[1] - s) + c;
                                }});
  });
}

/// Heat in a rod of n points, ends at 0; the first sine, an eigenvector, decays at its eigenvalue.
inline Trial rod(int n, bool declared) {
  const double c = (n + 1.0) * (n + 1.0), t = 0.1;
  Eigen::VectorXd sine(n);
  for (int i = 0; i < n; ++i) sine[i] = std::sin(std::numbers::pi * (i + 1) / (n + 1));
  const double half = std::sin(0.5 * std::numbers::pi / (n + 1));
  const auto leaf = make_leaf([&](Leaf& l) {
    l.declare_continuous_state({.initial = sine, .ode = [c](const At& at, VectorRef d) {
                                  const Index m = d.size();
                                  d = -2.0 * at.x;
                                  d.head(m - 1) += at.x.tail(m - 1);
                                  d.tail(m - 1) += at.x.head(m - 1);
                                  d *= c;
                                }});
    if (declared) l.declare_jacobian_sparsity(saltus::band_entries(n, 1, 1));
  });
  return trial(leaf, {0.0, t}, {.rtol = 1e-4, .atol = 1e-6},
               meets({.end = std::exp(-4.0 * c * half * half * t) * sine, .size = sine}));
}

inline Trial many_oscillators(const std::shared_ptr<const System>& system, Index n) {
  return trial(system, {0.0, 1.0}, {.rtol = 1e-6, .atol = 1e-8},
               meets({.end = turned(n, 1.0), .size = Eigen::VectorXd::Ones(2 * n), .growth = 2.0}));
}

inline Trial many_stiff(Index n) {
  Eigen::VectorXd end(2 * n);
  for (Index i = 0; i < n; ++i) end.segment(2 * i, 2) << std::cos(1.0), std::sin(1.0);
  return trial(stiff_leaves(n), {0.0, 1.0}, {.rtol = 1e-4, .atol = 1e-6},
               meets({.end = end, .size = Eigen::VectorXd::Ones(2 * n)}));
}

/// One guard in each of n leaves; leaf i resets at (i + 1) / n.
inline Trial guards_in_leaves(int n, int fire) {
  const auto system = of_leaves(n, [n](Leaf& l, Index i) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
    const double level = (static_cast<double>(i) + 1.0) / n;
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [level](const At& at) { return at.x[0] - level; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({-9.0}); },
         .direction = Direction::negative_then_non_negative});
  });
  return trial(system, {0.0, (fire + 0.5) / n}, {},
               meets({.times = spaced(1.0 / n, 1.0 / n, fire), .events = true}));
}

/// n guards at (i + 1) / n; the first `fire` of them fire.
inline Trial guards(int n, int fire, bool stop) {
  const double end = (fire + 0.5) / n;
  return trial(ramp(1.0, spaced(1.0 / n, 1.0 / n, n), stop), {0.0, end}, {},
               meets({.end = vec({end}), .times = spaced(1.0 / n, 1.0 / n, fire), .events = true}));
}

/// x' = 1, reset to 0 at 1, n times. Each restart may be late by a location error.
inline Trial sawtooth(int n) {
  const auto leaf = make_leaf([](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [](const At&) { return 1.0; }});
    l.declare_zero_crossing(
        {.name = "top",
         .guard = [](const At& at) { return 1.0 - at.x[0]; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = Direction::positive_then_non_positive});
  });
  return trial(leaf, {0.0, n + 0.5}, {.rtol = 1e-9, .atol = 1e-11},
               meets({.end = vec({0.5}),
                      .size = vec({1.0}),
                      .growth = static_cast<double>(n),
                      .times = spaced(1.0, 1.0, n),
                      .events = true}));
}

/// Contacts of a ball that loses no energy.
inline Trial elastic(int n) {
  return contacts_of({9.81, 1.0, 1.0}, n, {.rtol = 1e-9, .atol = 1e-11});
}

/// n updates 1e-3 s apart turn the sign of x' = z.
inline Trial updates(int n, double t0, double step) {
  const auto leaf = make_leaf([=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.z[0]; }});
    l.declare_discrete_state(vec({1.0}));
    l.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state(Eigen::VectorXd(-at.z)); }, step,
        t0 + step);
  });
  // up and down n / 2 times, so it ends at 0; a tick is a rounding of t early or late
  return trial(leaf, {t0, t0 + n * step}, {.atol = 1e-6 * step},
               meets({.end = vec({0.0}),
                      .size = vec({step}),
                      .growth = 1.0 + n * eps * (t0 + n * step) / (1e-6 * step)}));
}

}  // namespace detail

inline Group many() {
  using namespace detail;
  const auto scene = [](std::string name, Methods methods, std::function<Trial()> make,
                        bool quick = false) {
    return Case{.name = std::move(name),
                .methods = std::move(methods),
                .trials = one(std::move(make)),
                .quick = quick};
  };
  constexpr Index half = 50'000;
  return {
      .title = "Many of them",
      .text = "The time of building the plan is part of the run time.",
      .cases = {
          scene("1e5 states in a leaf: oscillators", every,
                [] { return many_oscillators(oscillators(half), half); }),
          scene("1e5 states in 5e4 leaves: oscillators", every,
                [] { return many_oscillators(oscillator_leaves(half), half); }),
          scene("1e5 states in a leaf: heat, h |lambda| to 4e9, band declared", stiff_ones,
                [] { return rod(100'000, true); }),
          scene(
              "1e4 states in a leaf: heat, nothing declared", stiff_ones,
              [] { return rod(10'000, false); }, true),
          scene("1e5 states in 5e4 stiff leaves", stiff_ones, [] { return many_stiff(half); }),
          scene(
              "2e3 guards of a leaf, monitors, all fire", every,
              [] { return guards(2000, 2000, false); }, true),
          scene("1e4 guards of a leaf, monitors, all fire", every,
                [] { return guards(10'000, 10'000, false); }),
          scene("1e4 guards of a leaf, 300 of them reset", every,
                [] { return guards(10'000, 300, true); }),
          scene("1e4 leaves with a guard each, 100 of them reset", runge_kutta,
                [] { return guards_in_leaves(10'000, 100); }),
          scene(
              "300 leaves with a guard each, all reset", every,
              [] { return guards_in_leaves(300, 300); }, true),
          scene("1e6 resets of a sawtooth", every, [] { return sawtooth(1'000'000); }),
          scene("1e6 contacts of a ball, e = 1", runge_kutta, [] { return elastic(1'000'000); }),
          scene(
              "1e4 contacts of a ball, e = 1", every, [] { return elastic(10'000); }, true),
          scene("1e6 updates that turn x' = z", every,
                [] { return updates(1'000'000, 0.0, 1e-3); }),
      }};
}

}  // namespace extremes
