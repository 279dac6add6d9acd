// CVODE in flights that are long: stiff ones between two resets, jumps of a millionth of the time,
// runs without an end.
#include <numbers>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A rod of n points that is heated again each time its middle has cooled to a half.
Leaf reheated_rod(Index n) {
  return Leaf("rod", [n](Leaf& l) {
    const double rate = 0.02 * std::pow(static_cast<double>(n) + 1.0, 2);
    const auto bump = [n](double a, double b, double c) -> Eigen::VectorXd {
      const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n, 1.0, static_cast<double>(n)) *
                               (std::numbers::pi / (static_cast<double>(n) + 1.0));
      return a * x.sin() + b * (4.0 * x).sin() + c * (5.0 * x).sin();
    };
    std::vector<MatrixEntry> places;
    for (int i = 0; i < n; ++i) {
      for (int j = std::max(0, i - 1); j <= std::min<int>(static_cast<int>(n) - 1, i + 1); ++j)
        places.push_back({i, j});
    }
    l.declare_continuous_state({.initial = bump(1.0, 0.1, 0.1),
                                .ode =
                                    [=](const At& at, VectorRef xdot) {
                                      xdot = -2.0 * rate * at.x;
                                      xdot.head(n - 1) += rate * at.x.tail(n - 1);
                                      xdot.tail(n - 1) += rate * at.x.head(n - 1);
                                    },
                                .sparsity = places});
    l.declare_zero_crossing(
        {.name = "cool",
         .guard = [n](const At& at) { return at.x[(n - 1) / 2] - 0.5; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state(at.x + bump(0.5, 0.3, 0.25)); },
         .direction = Direction::positive_then_non_positive});
  });
}

Leaf van_der_pol(double mu) {
  return Leaf("van_der_pol", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({2.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], mu * (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
         }});
  });
}

}  // namespace

TEST_CASE("a stiff flight after a reset is BDF's, whatever the tolerance and the number of states",
          "[laws][bdf]") {
  const auto method = GENERATE(Method::bdf, Method::automatic);
  const double rtol = GENERATE(1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8);
  const Index n = GENERATE(49, 199);
  const Leaf rod = reheated_rod(n);
  const auto results = simulate(rod, rod.create_context(), {0.0, 20.0},
                                {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = method});
  INFO(method << ", rtol " << rtol << ", " << n << " points: " << results.statistics.method);
  REQUIRE(results.events.size() >= 2);
  // One flight of BDF takes 26 steps to start and then 100 at most (measured 40 to 130). An
  // explicit method takes 0.08 (n + 1)^2 / 3.3 for each second: 60 and 970.
  const auto flights = static_cast<std::int64_t>(results.events.size()) + 1;
  CHECK(results.statistics.steps < 200 * flights);
}

TEST_CASE("BDF passes jumps that take some roundings of the time", "[laws][bdf]") {
  const double rtol = GENERATE(1e-8, 1e-10, 1e-12);
  const Leaf leaf = van_der_pol(1e6);  // jumps of 1e-6 s at t = 8e5 s
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.2e6},
               {.rtol = rtol, .atol = 1e-2 * rtol, .ode_solver_method = Method::bdf});
  CHECK(results.status == Status::reached_end);
  CHECK(results.context.continuous_state()[0] < -1.0);  // it has jumped
}

TEST_CASE("a run without an end stops at its terminal event, by every method", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double start = GENERATE(0.0, 1e6);  // [s]
  const Leaf ball("ball", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({10.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    l.declare_zero_crossing({.name = "floor",
                             .guard = [](const At& at) { return at.x[0]; },
                             .direction = Direction::positive_then_non_positive,
                             .terminal = true});
  });
  const auto results = simulate(ball, ball.create_context().with_time(start), {start, infinite},
                                {.rtol = 1e-8, .atol = 1e-10, .ode_solver_method = method});
  CHECK(results.status == Status::terminal);
  // The error of the height, a hundred tolerances for multistep methods, over the speed of 14 m/s;
  // the rounding of the time.
  CHECK(std::abs(results.context.time() - start - std::sqrt(20.0 / 9.81)) <
        1e-6 / 14.0 + 1e3 * eps * start);
}

TEST_CASE("a stiff run without an end stops at its terminal event", "[laws]") {
  const auto method = GENERATE(Method::bdf, Method::radau, Method::automatic);
  // x0 follows cos t at a rate of 1e6; x1' = 1 / 1000.
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << 1e6 * (std::cos(at.time) - at.x[0]), 1e-3;
         }});
    l.declare_zero_crossing({.name = "full",
                             .guard = [](const At& at) { return at.x[1] - 0.1; },
                             .direction = Direction::negative_then_non_negative,
                             .terminal = true});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, infinite},
                                {.rtol = 1e-6, .atol = 1e-8, .ode_solver_method = method});
  CHECK(results.status == Status::terminal);
  // Ten tolerances of x1, over its speed.
  CHECK(std::abs(results.context.time() - 100.0) < 10.0 * (1e-7 + 1e-8) / 1e-3);
  CHECK(
      (contains(results.statistics.method, "bdf") || contains(results.statistics.method, "radau")));
}
