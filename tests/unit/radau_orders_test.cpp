// The orders of the Radau methods, by halving the length of the steps: 2 S - 1 at the ends of steps
// and at events, which end a step, with S stages; S and more inside steps.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// S stages: steps of h, after `rest` steps in which nothing moves. After each ten of those the
/// number of stages rises.
struct Case {
  int stages, rest;
  double h;  // [s] so long that the errors are far above rounding
};

const std::vector<Case> cases{{3, 5, 0.5}, {5, 15, 2.0}, {7, 25, 4.0}};
constexpr int moving = 4;  // [steps of h]

/// x' = -x from 1 at `start`, 0 before. Newton's iteration is exact.
Leaf decay(double start, double level) {
  return Leaf("decay", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}),
                                .ode = [](const At& at) { return -at.x[0]; },
                                .jacobian = [](const At&, MatrixRef j) { j << -1.0; }});
    l.declare_continuous_state_output("x");
    l.declare_one_shot(start, [](const At&, Next& next) { next.set_continuous_state({1.0}); });
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [level](const At& at) { return at.x[0] - level; },
         .reset_map = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

struct Decay {
  double begin;  // [s] of the motion
  Results results;
  /// The largest relative error of the rows of the motion.
  double error() const {
    double largest = 0.0;
    const auto x = results.output("x");
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      if (results.time[i] <= begin) continue;
      const double exact = std::exp(begin - results.time[i]);
      largest = std::max(largest, std::abs(x(static_cast<Index>(i), 0) / exact - 1.0));
    }
    return largest;
  }
};

/// A run with `parts` steps for each h. The tolerance is so loose that no step is rejected. Rows at
/// these parts of the motion, and an event at `level`.
Decay run(const Case& with, int parts, const std::vector<double>& rows, double level = -1.0) {
  const double h = with.h / parts, begin = with.rest * h, length = moving * with.h;
  std::vector<double> save_at;
  for (const double row : rows) save_at.push_back(begin + row * length);
  const Leaf leaf = decay(begin, level);
  Results results = simulate(leaf, leaf.create_context(), {0.0, begin + length},
                             {.rtol = 1.0,
                              .atol = 1.0,
                              .ode_solver_method = Method::radau,
                              .max_minor_step_size = h,
                              .first_step = h,
                              .recorded_signals = {{"x", leaf.output(0)}},
                              .save_at = std::move(save_at)});
  CHECK(results.statistics.rejected == 0);
  return {begin, std::move(results)};
}

}  // namespace

TEST_CASE("ends of steps have order 2 S - 1, and looks inside them S and more", "[radau]") {
  const Case with = GENERATE(from_range(cases));
  INFO(with.stages << " stages");
  std::vector<double> inside;
  for (int i = 1; i < 160; ++i) inside.push_back((i + 0.01) / 160.0);
  const Decay once = run(with, 1, {1.0}), twice = run(with, 2, {1.0});
  CHECK(once.results.statistics.steps == with.rest + moving);
  CHECK(twice.results.statistics.steps == with.rest + 2 * moving);
  const double order = std::log2(once.error() / twice.error());
  CHECK(order > 2 * with.stages - 1.5);
  CHECK(order < 2 * with.stages - 0.5);
  const double coarse = run(with, 1, inside).error(), fine = run(with, 2, inside).error();
  CHECK(std::log2(coarse / fine) > with.stages + 0.5);
  CHECK(std::log2(coarse / fine) < with.stages + 2.5);
  CHECK(twice.error() < 0.1 * fine);  // which is why a step that an event cuts is taken again
}

TEST_CASE("an event has the order of the steps, not that of the dense output", "[radau]") {
  const Case with = GENERATE(from_range(cases));
  INFO(with.stages << " stages");
  // Inside the third step of h, and the fifth of h / 2.
  const double flight = 2.4 * with.h;
  double time[2], state[2];
  for (const int k : {0, 1}) {
    const Decay decay = run(with, k + 1, {1.0}, std::exp(-flight));
    REQUIRE(decay.results.events.size() == 2);
    const auto& event = decay.results.events[1];
    time[k] = std::abs(event.time - decay.begin - flight);
    state[k] = decay.error();
  }
  // A point at a fixed part of a step would have the order S + 1 of the collocation polynomial. The
  // last step is 0.4 of h, and 0.8 of h / 2, which adds less than one to 2.
  CHECK(std::log2(time[0] / time[1]) > 2 * with.stages - 1.7);
  CHECK(std::log2(state[0] / state[1]) > 2 * with.stages - 1.7);
}
