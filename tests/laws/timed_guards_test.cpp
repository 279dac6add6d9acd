// Guards that follow the time, beside states that let the steps of a method grow: each pair of
// crossings is found, also in the steps after a restart.
#include <array>
#include <cmath>
#include <random>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);

/// u(t) = amplitude cos(phase + frequency t + growth t^2) + bias, and a level.
struct Wave {
  double amplitude, frequency, phase, bias, level = 0.5, growth = 0.0;

  double angle(double t) const { return phase + frequency * t + growth * t * t; }
  double at(double t) const { return amplitude * std::cos(angle(t)) + bias; }
  /// The cosine at a crossing.
  double crossed() const { return (level - bias) / amplitude; }
  /// The first time at which the angle is this, which grows with the time.
  double time(double of) const {
    const double c = phase - of;
    return -2.0 * c / (frequency + std::sqrt(frequency * frequency - 4.0 * growth * c));
  }
  /// The times in (0, end) at which u is the level, in order.
  std::vector<double> crossings(double end) const {
    std::vector<double> times;
    if (std::abs(crossed()) >= 1.0) return times;
    const double half = std::acos(crossed());
    for (double turn = std::floor(phase / (2.0 * pi)) - 1.0; turn * 2.0 * pi - half < angle(end);
         turn += 1.0) {
      for (const double of : {2.0 * pi * turn - half, 2.0 * pi * turn + half})
        if (of > phase && of < angle(end)) times.push_back(time(of));
    }
    return times;
  }
  /// [s] How long u is above the level.
  double above(double end) const {
    double sum = 0.0, since = 0.0;
    bool high = at(0.0) > level;
    for (const double t : crossings(end)) {
      if (high) sum += t - since;
      since = t, high = !high;
    }
    return high ? sum + end - since : sum;
  }
  /// [s] A crossing is found within the rounding of the angle and of the sum with the bias, and
  /// within the bracket of a root.
  double allowed(double end) const {
    const double slope = std::sqrt(1.0 - crossed() * crossed()) * frequency;
    const double rounding = angle(end) + 1.0 + std::abs(bias / amplitude);
    return 8.0 * eps * rounding / slope + 200.0 * eps * end;
  }
};

/// Random waves of 0.5 to 4 rad/s that do not graze the level; the first is one whose second pair of
/// crossings was missed.
std::vector<Wave> waves(std::size_t count, double growth = 0.0) {
  std::vector<Wave> found{{1.9, 3.25, 0.7 - 0.5 * pi, -0.35, 0.5, growth}};
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) * 0x1p-32);
  };
  while (found.size() < count) {
    const double amplitude = between(0.5, 2.5), frequency = between(0.5, 4.0);
    const Wave wave{amplitude, frequency, between(-1.5, 4.5), between(-1.0, 1.0), 0.5, growth};
    if (std::abs(wave.crossed()) < 0.98) found.push_back(wave);
  }
  return found;
}

/// A scene in which x' = 1 while u is above the level, x(0) = 0, and the block of x is called "x".
using MakeScene = Diagram (*)(const Wave&);

/// The block "x" integrates a Comparator of a signal and the level.
void integrate(DiagramBuilder& builder, const OutputPort& signal, double level) {
  auto& comparator = builder.add<Comparator>("above", ">");
  auto& constant = builder.add<Constant>("level", level);
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(signal, comparator.input(0));
  builder.connect(constant.output(), comparator.input(1));
  builder.connect(comparator.output(), x.input());
}

Sine& add_sine(DiagramBuilder& builder, const std::string& name, const Wave& of) {
  return builder.add<Sine>(name, SineOptions{.amplitude = of.amplitude,
                                             .frequency = of.frequency,
                                             .phase = of.phase + 0.5 * pi,
                                             .bias = of.bias});
}

Diagram behind_a_sine(const Wave& of) {
  DiagramBuilder builder;
  integrate(builder, add_sine(builder, "sine", of).output(), of.level);
  return builder.build();
}

Diagram behind_a_called_output(const Wave& of) {
  DiagramBuilder builder;
  const auto source = make_leaf("called", [of](Leaf& l) {
    l.declare_output_port(
        {.name = "out", .calc = [of](const At& at, VectorRef y) { y[0] = of.at(at.time); }});
  });
  builder.add(source);
  integrate(builder, source->output(), of.level);
  return builder.build();
}

/// cos a cos b = (cos(a - b) + cos(a + b)) / 2, of two sines of one frequency.
Diagram behind_a_product(const Wave& of) {
  DiagramBuilder builder;
  const double apart = std::acos(of.bias / of.amplitude);  // of their angles
  const auto factor = [&](const char* name, double amplitude, double shift) -> Sine& {
    return add_sine(builder, name, {amplitude, 0.5 * of.frequency, 0.5 * (of.phase + shift), 0.0});
  };
  auto& product = builder.add<Product>("product");
  builder.connect(factor("a", 2.0 * of.amplitude, apart).output(), product.input(0));
  builder.connect(factor("b", 1.0, -apart).output(), product.input(1));
  integrate(builder, product.output(), of.level);
  return builder.build();
}

/// A state that the truth does not move, with slow steps: x' = -x.
Diagram beside_a_slow_state(const Wave& of) {
  DiagramBuilder builder;
  integrate(builder, add_sine(builder, "sine", of).output(), of.level);
  auto& one = builder.add<Constant>("one", 1.0);
  auto& lag = builder.add<TransferFunction>("lag", vec({1.0}), vec({1.0, 1.0}));
  builder.connect(one.output(), lag.input());
  return builder.build();
}

/// A ramp beside it falls from 0.9 to 0 by a reset, which restarts the method.
Diagram beside_resets(const Wave& of) {
  DiagramBuilder builder;
  integrate(builder, add_sine(builder, "sine", of).output(), of.level);
  builder.add(make_leaf("ramp", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .formula = Formula([](const auto& at) {
                                                         return at.x(0) * 0.0 + 1.0;
                                                       })});
    l.declare_zero_crossing(
        {.name = "fall",
         .reset_map = [](const At&, Next& next) { next.set_continuous_state(vec({0.0})); },
         .direction = Direction::negative_then_non_negative,
         .formula = Formula([](const auto& at) { return at.x(0) - 0.9; })});
  }));
  return builder.build();
}

/// x' = z, where the firings of the guard change z between 0 and 1.
template <class Declare>
Diagram switched(const Wave& of, Declare guard) {
  DiagramBuilder builder;
  builder.add(make_leaf("x", [&](Leaf& l) {
    l.declare_discrete_state(vec({of.at(0.0) > of.level ? 1.0 : 0.0}));
    l.declare_continuous_state(
        {.initial = vec({0.0}), .formula = Formula([](const auto& at) { return at.z(0) + 0.0; })});
    l.declare_zero_crossing(
        guard(ZeroCrossing{.name = "change", .reset_map = [](const At& at, Next& next) {
                             next.set_discrete_state(vec({1.0 - at.z[0]}));
                           }}));
  }));
  return builder.build();
}
Diagram in_a_guard(const Wave& of) {
  return switched(of, [of](ZeroCrossing one) {
    one.formula = Formula([of](const auto& at) {
      using std::cos;
      const auto t = at.time();
      return of.amplitude * cos(of.phase + of.frequency * t) + of.bias - of.level;
    });
    return one;
  });
}
Diagram in_a_called_guard(const Wave& of) {
  return switched(of, [of](ZeroCrossing one) {
    one.guard = [of](const At& at) { return of.at(at.time) - of.level; };
    return one;
  });
}

/// The same of a state that is the time, as a function in C++ that is called.
Diagram in_a_called_guard_of_a_clock(const Wave& of) {
  DiagramBuilder builder;
  builder.add(make_leaf("x", [&](Leaf& l) {
    l.declare_discrete_state(vec({of.at(0.0) > of.level ? 1.0 : 0.0}));
    l.declare_continuous_state(
        {.initial = vec({0.0, 0.0}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                       xdot[0] = at.z(0) + 0.0, xdot[1] = at.z(0) * 0.0 + 1.0;
                                     })});
    l.declare_zero_crossing(
        {.name = "change",
         .guard = [of](const At& at) { return of.at(at.x[1]) - of.level; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state(vec({1.0 - at.z[0]})); }});
  }));
  return builder.build();
}
/// A clock of its own, 1 + 2 t, whose called output is the wave.
Diagram behind_a_called_output_of_a_clock(const Wave& of) {
  DiagramBuilder builder;
  const auto source = make_leaf("clock", [of](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0}), .formula = Formula([](const auto& at) {
                                                         return at.x(0) * 0.0 + 2.0;
                                                       })});
    l.declare_output_port({.name = "out", .calc = [of](const At& at, VectorRef y) {
                             y[0] = of.at(0.5 * (at.x[0] - 1.0));
                           }});
  });
  builder.add(source);
  integrate(builder, source->output(), of.level);
  return builder.build();
}

/// The frequency of a Chirp grows from f0 to f1 at stop_time: amplitude 1, and no bias.
Diagram behind_a_chirp(const Wave& of) {
  constexpr double stop = 40.0;
  DiagramBuilder builder;
  auto& chirp =
      builder.add<Chirp>("chirp", ChirpOptions{.f0 = of.frequency,
                                               .f1 = of.frequency + 2.0 * of.growth * stop,
                                               .stop_time = stop,
                                               .phi = of.phase});
  integrate(builder, chirp.output(), of.level);
  return builder.build();
}

struct Row {
  const char* name;
  MakeScene scene;
};
constexpr std::array rows{
    Row{"behind a sine", behind_a_sine},
    Row{"behind a called output", behind_a_called_output},
    Row{"behind a product", behind_a_product},
    Row{"beside a slow state", beside_a_slow_state},
    Row{"beside resets", beside_resets},
    Row{"in a guard", in_a_guard},
    Row{"in a called guard", in_a_called_guard},
    Row{"in a called guard of a clock", in_a_called_guard_of_a_clock},
    Row{"behind a called output of a clock", behind_a_called_output_of_a_clock}};

/// The firings that change x, and x at the end, in closed form.
void check(const char* name, const Diagram& diagram, const Wave& of, Method method, double rtol,
           double end) {
  const auto results = simulate(
      diagram, diagram.create_context(), {0.0, end},
      {.rtol = rtol, .atol = 0.01 * rtol, .ode_solver_method = method, .save_steps = false});
  std::vector<double> times;
  for (std::size_t i = 0; i < results.events.size(); ++i)
    if (results.events[i].name != "fall") times.push_back(results.events[i].time);
  const std::vector<double> expected = of.crossings(end);
  const std::string scene =
      text(name, " ", of.amplitude, " ", of.frequency, " ", of.phase, " ", of.bias, " ", rtol);
  within(scene, method, worst(times, expected), of.allowed(end));
  // Each piece of x begins and ends at a crossing, and the sum is rounded.
  const double x = results.context[diagram["x"].system_id()].continuous_state()[0];
  within(scene + ", x", method, std::abs(x - of.above(end)),
         static_cast<double>(times.size() + 1) * (of.allowed(end) + 8.0 * eps * end));
}

constexpr std::array all_methods{Method::dopri5, Method::dop853, Method::adams,    Method::bdf,
                                 Method::radau,  Method::taylor, Method::automatic};

}  // namespace

TEST_CASE("every crossing of a guard that follows the time is found, whatever the steps are",
          "[laws][guards]") {
  const auto method = GENERATE(from_range(all_methods));
  const auto rtol = GENERATE(1e-3, 1e-6, 1e-10);
  const double end = GENERATE(12.0, 60.0);
  const Row row = GENERATE(from_range(rows));
  for (const Wave& of : waves(30)) {
    if (row.scene == behind_a_product && std::abs(of.bias) > std::abs(of.amplitude)) continue;
    check(row.name, row.scene(of), of, method, rtol, end);
  }
}

TEST_CASE("every crossing of a chirp is found, which is slow where the run begins",
          "[laws][guards]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::adams, Method::bdf,
                               Method::radau, Method::automatic);  // taylor has no series of it
  const auto rtol = GENERATE(1e-3, 1e-6, 1e-10);
  for (Wave of : waves(30, 0.25)) {
    of.amplitude = 1.0, of.bias = 0.0, of.level = 0.5;
    check("behind a chirp", behind_a_chirp(of), of, method, rtol, 12.0);
  }
}
