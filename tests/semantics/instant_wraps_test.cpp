// Semantics 3.4: what counts as carried across zero.
#include <numbers>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double pi = std::numbers::pi;

/// A state that goes round between `low` and `high` at this rate, with a guard at either end.
Leaf circle(double low, double high, double rate) {
  return Leaf("circle", [=](Leaf& l) {
    declare_ramp(l, rate, low + 0.4 * (high - low));
    const auto move = [](double by) {
      return [=](const At& at, Next& next) { next.set_continuous_state({at.x[0] + by}); };
    };
    l.declare_zero_crossing({.name = "up",
                             .guard = [=](const At& at) { return at.x[0] - high; },
                             .reset_map = move(low - high),
                             .direction = Direction::negative_then_non_negative});
    l.declare_zero_crossing({.name = "down",
                             .guard = [=](const At& at) { return at.x[0] - low; },
                             .reset_map = move(high - low),
                             .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("3.4 a state that wraps round does not ring between its two ends", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  using Ends = std::pair<double, double>;
  const auto [low, high] = GENERATE(Ends{0.0, 1.0}, Ends{-pi, pi}, Ends{-1.0 / 3.0, 2.0 / 3.0},
                                    Ends{1e6, 1e6 + 1.0}, Ends{-0.7, 0.0});
  const double turns = GENERATE(0.37, -0.37, 2.9, -2.9);  // [1/s]
  const Leaf leaf = circle(low, high, turns * (high - low));
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 10.0}, {.ode_solver_method = method});
  INFO(method << ", [" << low << ", " << high << "), " << turns << " turns a second");
  // From 0.4 of the way: the number of whole turns that are over after ten seconds.
  const double way = 0.4 + 10.0 * turns;
  const auto expected = static_cast<std::size_t>(turns > 0.0 ? std::floor(way) : -std::floor(way));
  CHECK(results.events.times(turns > 0.0 ? "up" : "down").size() == expected);
  CHECK(results.events.times(turns > 0.0 ? "down" : "up").empty());
}

TEST_CASE("3.4 a cell index that moves on does not move back", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double rate = GENERATE(1.0, -1.0, 0.3);
  const Leaf leaf("grid", [=](Leaf& l) {
    declare_ramp(l, rate, 0.5);
    l.declare_discrete_state(vec({0.0}));
    const auto move = [](double by) {
      return [=](const At& at, Next& next) { next.set_discrete_state({at.z[0] + by}); };
    };
    l.declare_zero_crossing({.name = "right",
                             .guard = [](const At& at) { return at.x[0] - (at.z[0] + 1.0); },
                             .reset_map = move(1.0),
                             .direction = Direction::negative_then_non_negative});
    l.declare_zero_crossing({.name = "left",
                             .guard = [](const At& at) { return at.x[0] - at.z[0]; },
                             .reset_map = move(-1.0),
                             .direction = Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.2}, {.ode_solver_method = method});
  CHECK(results.context.discrete_state()[0] == std::floor(0.5 + 20.2 * rate));
  CHECK(results.events.times(rate > 0.0 ? "left" : "right").empty());
}

TEST_CASE("3.4 a guard that a commit puts at zero, where it stays, has arrived", "[semantics]") {
  const Leaf leaf("count", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "half",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state({0.0});
                                   next.set_discrete_state({at.z[0] + 1.0});
                                 }});
    l.declare_zero_crossing({.name = "three",
                             .guard = [](const At& at) { return 3.0 - at.z[0]; },
                             .direction = Direction::positive_then_non_positive,
                             .terminal = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 10.0},
                                {.ode_solver_method = GENERATE(from_range(methods))});
  CHECK(results.status == Status::terminal);
  CHECK(std::abs(results.context.time() - 1.5) < 100.0 * eps * 2.0);
}

TEST_CASE("3.4 pulse-coupled neurons: who is carried over the threshold fires at the same time",
          "[semantics]") {
  // Three neurons of rate 1 with a threshold of 1. A firing sets its neuron to 0 and gives each
  // other neuron that has not fired in the same avalanche 0.2.
  const Leaf leaf("neurons", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.95, 0.8, 0.3}),
                                .ode = [](const At&, VectorRef xdot) { xdot.setOnes(); }});
    l.declare_zero_crossing(
        {.name = "fire",
         .guard = VectorFunction([](const At& at, VectorRef g) { g = at.x.array() - 1.0; }),
         .reset_map =
             [](const At& at, Next& next) {
               Eigen::VectorXd v = at.x;
               for (Index i = 0; i < 3; ++i)
                 if (i != at.entry && v[i] > 0.0) v[i] += 0.2;
               v[at.entry] = 0.0;
               next.set_continuous_state(v);
             },
         .direction = Direction::negative_then_non_negative,
         .size = 3});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 0.5},
                                {.ode_solver_method = GENERATE(from_range(methods))});
  // At 0.05 s the first fires, 0.85 + 0.2 carries the second over; the third has 0.35 + 0.4 and
  // fires at 0.05 + 0.25 s. The first two then have 0.25 + 0.2.
  const std::vector<double> times = results.events.times("fire");
  REQUIRE(times.size() == 3);
  CHECK(std::abs(times[0] - 0.05) < 100.0 * eps);
  CHECK(times[1] == times[0]);
  CHECK(std::abs(times[2] - 0.3) < 100.0 * eps);
  CHECK(std::abs(results.context.continuous_state()[0] - 0.65) < 1e-14);
}
