// Close pairs: random smooth guards that dip through zero for a moment, by all methods.
#include <random>

#include "support/cases.hpp"
#include "support/oscillator.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A sum of sines of the time, and the places where it turns.
struct Waves {
  explicit Waves(std::mt19937& draw) {
    const auto pick = [&](double from, double to) {
      return std::uniform_real_distribution(from, to)(draw);
    };
    const int count = std::uniform_int_distribution(1, 4)(draw);
    for (int i = 0; i < count; ++i)
      waves.push_back({pick(0.2, 1.0), pick(0.2, 3.0), pick(0.0, 6.28)});
  }
  struct Wave {
    double size, rate, phase;
  };
  std::vector<Wave> waves;
  double level = 0.0;

  double operator()(double t) const {
    double sum = -level;
    for (const auto& [size, rate, phase] : waves) sum += size * std::sin(rate * t + phase);
    return sum;
  }
  double slope(double t) const {
    double sum = 0.0;
    for (const auto& [size, rate, phase] : waves) sum += size * rate * std::cos(rate * t + phase);
    return sum;
  }
};

/// Where f changes its sign between a and b, at whose ends it has different signs.
template <class F>
double root(const F& f, double a, double b) {
  const bool positive = f(a) > 0.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(middle) > 0.0) == positive ? a : b) = middle;
  }
  return b;
}

constexpr double end = 12.0;

/// Where the waves turn, and the end.
std::vector<double> turns_of(const Waves& waves) {
  const auto slope = [&](double t) { return waves.slope(t); };
  std::vector<double> turns;
  constexpr int parts = 4000;
  for (int i = 0; i < parts; ++i) {
    const double a = end * i / parts, b = end * (i + 1) / parts;
    if ((slope(a) > 0.0) != (slope(b) > 0.0)) turns.push_back(root(slope, a, b));
  }
  return turns;
}

std::vector<double> zeros_of(const Waves& waves, std::vector<double> turns) {
  turns.push_back(end);
  std::vector<double> zeros;
  double from = 0.0;
  for (const double to : turns) {
    if ((waves(from) > 0.0) != (waves(to) > 0.0)) zeros.push_back(root(waves, from, to));
    from = to;
  }
  return zeros;
}

/// Waves of which one turns `depth` beyond zero. False if another turn cannot be told from zero.
bool make_dip(Waves& waves, const std::vector<double>& turns, double depth, std::mt19937& draw) {
  const double at = turns[std::uniform_int_distribution<std::size_t>(0, turns.size() - 1)(draw)];
  const bool valley = waves.slope(at + 1e-4) > 0.0;
  waves.level = waves(at) + (valley ? depth : -depth);
  return std::ranges::all_of(turns, [&](double t) { return std::abs(waves(t)) > 0.5 * depth; });
}

}  // namespace

TEST_CASE("random smooth guards that dip through zero fire twice", "[laws][guards]") {
  const auto method = GENERATE(from_range(methods));
  const bool counts = GENERATE(true, false);
  std::mt19937 draw(7);
  for (int i = 0; i < 60; ++i) {
    Waves waves(draw);
    const std::vector<double> turns = turns_of(waves);
    // Rounding moves a crossing by eps / sqrt(depth).
    const double depth = std::pow(10.0, std::uniform_real_distribution(-8.0, -1.0)(draw));
    const double rtol = std::pow(10.0, std::uniform_real_distribution(-9.0, -3.0)(draw));
    if (turns.empty() || !make_dip(waves, turns, depth, draw)) continue;
    const auto leaf = make_leaf("leaf", [&](Leaf& l) {
      declare_oscillator(l);
      l.declare_discrete_state(vec({0.0}));
      l.declare_zero_crossing({.name = "g",
                               .guard = [&](const At& at) { return waves(at.time); },
                               .reset_map = counts ? ResetMap(count_up) : ResetMap()});
    });
    const auto results = simulate(*leaf, leaf->create_context(), {0.0, end},
                                  {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = method});
    within(text("dip ", i, " of ", depth, " at rtol ", rtol, counts ? "" : ", monitor"), method,
           worst(firing_times(results.events), zeros_of(waves, turns)),
           200.0 * eps * end + 16.0 * eps / std::sqrt(depth));
  }
}
