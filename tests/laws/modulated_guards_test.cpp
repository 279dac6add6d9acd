// Guards of the time whose amplitude comes and goes: while it is small, looks far apart are enough, and
// when it grows again they must not have the period of the guard.
#include <functional>
#include <random>

#include "support/cases.hpp"
#include "support/crossings.hpp"

using namespace saltus;
using namespace support;

namespace {

const double pi = std::acos(-1.0);
constexpr double end = 30.0;

/// g(t) = cos(slow t + 0.3) sin(fast t + phase) - level.
struct Beat {
  double fast, slow, phase, level;

  double operator()(double t) const {
    return std::cos(slow * t + 0.3) * std::sin(fast * t + phase) - level;
  }
};

/// With 200 points in each period.
Crossings crossings_of(const Beat& g) { return {g, 2.0 * pi / g.fast / 200.0, end}; }

/// A slow state, whose steps are as long as the tolerance allows, and the guard.
std::shared_ptr<Leaf> scene(const Beat& g, bool counts) {
  return make_leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({3.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot[0] = 0.02, xdot[1] = -0.3 * at.x[1]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [=](const At& at) { return g(at.time); },
                             .reset_map = counts ? ResetMap(count_up) : ResetMap()});
  });
}

/// Random beats of which no extremum is near zero: a dip of 1e-3 is longer than a sixth of the distance of two
/// of the 24 looks in a period.
std::vector<Beat> beats(std::size_t count) {
  // The first is one of which eleven crossings in a row were missed.
  std::vector<Beat> found{
      {21.26617046256585, 0.2926047680407973, 4.093680599093869, 0.351729860003353}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  while (found.size() < count) {
    const Beat beat{std::pow(10.0, 0.5 + 1.3 * part(random)), std::pow(10.0, -0.9 + part(random)),
                    2.0 * pi * part(random), 0.1 + 0.6 * part(random)};
    if (crossings_of(beat).margin > 0.03) found.push_back(beat);
  }
  return found;
}

}  // namespace

TEST_CASE("the crossings of a guard whose amplitude comes and goes are found", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(false, true);
  int k = 0;
  for (const Beat& beat : beats(24)) {
    const std::vector<double> expected = crossings_of(beat).times;
    for (const double rtol : {1e-2, 1e-3, 1e-4, 1e-6}) {
      const auto leaf = scene(beat, counts);
      const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                    {.rtol = rtol, .ode_solver_method = method});
      // The slope at a crossing is at least the root of margin (2 level) fast^2 / 2; the angle has its
      // rounding.
      within(text("beat ", k, " ", rtol, counts ? "" : ", monitor"), method,
             worst(firing_times(results.events), expected), 1e-9);
    }
    ++k;
  }
}
