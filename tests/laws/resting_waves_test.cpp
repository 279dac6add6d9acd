// Guards by sines of the time that are at rest for some periods, or far from zero, and turn again: their
// expressions say how far apart looks may be.
#include <functional>
#include <random>

#include "support/cases.hpp"
#include "support/crossings.hpp"

using namespace saltus;
using namespace support;

namespace resting_waves {

const double pi = std::acos(-1.0);
constexpr double end = 30.0;

enum class Kind { pulsed, lifted, chirped };

/// A fast sine that is zero for half of each slow period, or far from zero.
struct Wave {
  Kind shape;
  double fast, slow, phase, level;

  template <class T>
  T operator()(const T& t) const {
    using std::cos, std::sin, std::max;
    const T wave = sin(fast * t + phase), slowly = cos(slow * t + 0.3);
    if (shape == Kind::lifted) return wave - 1.4 + 1.2 * slowly;
    const T part = positive(slowly);
    if (shape == Kind::chirped) return part * sin((fast + 0.02 * fast * t) * t + phase) - level;
    return part * wave - level;
  }
  static double positive(double v) { return std::max(v, 0.0); }
  static tape::Symbol positive(const tape::Symbol& v) {
    return tape::Symbol::apply(tape::Op::maximum, {v, tape::Symbol(0.0)});
  }
};

/// With 400 points in each period.
Crossings crossings_of(const Wave& g) { return {g, 2.0 * pi / g.fast / 400.0, end}; }

std::shared_ptr<Leaf> scene(const Wave& g, bool counts) {
  return make_leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({3.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot[0] = 0.02, xdot[1] = -0.3 * at.x[1]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .reset_map = counts ? ResetMap(count_up) : ResetMap(),
                             .formula = [=](const auto& at) { return g(at.time()); }});
  });
}

/// Random waves of which no extremum is near zero, see modulated_guards_test.
std::vector<Wave> waves(Kind shape, std::size_t count) {
  std::vector<Wave> found;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  while (found.size() < count) {
    const Wave wave{shape, std::pow(10.0, 0.5 + 1.8 * part(random)),
                    std::pow(10.0, -0.9 + part(random)), 2.0 * pi * part(random),
                    0.1 + 0.6 * part(random)};
    if (crossings_of(wave).margin > 0.02) found.push_back(wave);
  }
  return found;
}

}  // namespace resting_waves

using namespace resting_waves;

TEST_CASE("the crossings of a sine that rests for some periods are found", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(false, true);
  const auto shape = GENERATE(Kind::pulsed, Kind::lifted, Kind::chirped);
  int k = 0;
  for (const Wave& wave : waves(shape, 40)) {
    const std::vector<double> expected = crossings_of(wave).times;
    for (const double rtol : {1e-2, 1e-3, 1e-6}) {
      const auto leaf = scene(wave, counts);
      const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                    {.rtol = rtol, .ode_solver_method = method});
      // The slope at a crossing is at least that of modulated_guards_test.
      within(text("wave ", k, " of shape ", static_cast<int>(shape), " ", rtol,
                  counts ? "" : ", monitor"),
             method, worst(firing_times(results.events), expected), 1e-9);
    }
    ++k;
  }
}
