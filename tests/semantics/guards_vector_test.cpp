// Semantics 2.1 with `size`: n guards that one call computes, each of which fires for itself.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

constexpr Index n = 4;
constexpr double g = 10.0, e = 0.5;
const std::array heights{0.2, 0.45, 0.8, 1.25};  // [m]: first contacts at 0.2, 0.3, 0.4, 0.5 s

/// n balls in one leaf: heights, then velocities; one vector of guards.
Leaf balls(bool each_rests_alone) {
  return Leaf("balls", [=](Leaf& l) {
    Eigen::VectorXd initial = Eigen::VectorXd::Zero(2 * n);
    std::ranges::copy(heights, initial.begin());
    l.declare_continuous_state({.initial = initial, .ode = [](const At& at, VectorRef xdot) {
                                  xdot.head(n) = at.x.tail(n);
                                  xdot.tail(n).setConstant(-g);
                                }});
    l.declare_continuous_state_output("state");
    ZeroCrossing bounce{.name = "bounce",
                        .guard = [](const At& at, VectorRef out) { out = at.x.head(n); },
                        .reset_map =
                            [](const At& at, Next& next) {
                              Eigen::VectorXd x = at.x;
                              x[at.entry] = 0.0;
                              x[n + at.entry] *= -e;
                              next.set_continuous_state(x);
                            },
                        .direction = Direction::positive_then_non_positive,
                        .size = n};
    for (int i = 0; each_rests_alone && i < n; ++i)
      bounce.holds.push_back({i, static_cast<int>(n) + i});
    l.declare_zero_crossing(bounce);
  });
}

}  // namespace

TEST_CASE("2.1 each of a vector of guards fires for itself, and its reset map knows which",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = balls(true);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 0.55},
                                {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method});
  // Contacts: 0.2, 0.4; 0.3; 0.4; 0.5 and 0.5 of the first again (0.2 + 0.2 + 0.1).
  std::vector<double> expected;
  for (const double h : heights) {
    const BallExact exact{g, e, h};
    for (int k = 1; exact.contact(k) < 0.55; ++k) expected.push_back(exact.contact(k));
  }
  std::ranges::sort(expected);
  const auto found = results.events.times("bounce");
  REQUIRE(found.size() >= expected.size() - 1);  // the first ball comes to rest at 0.6 s
  for (std::size_t i = 0; i < 5; ++i) CHECK_THAT(found[i], WithinAbs(expected[i], 1e-7));
}

TEST_CASE("2.1 a monitor may be a vector of guards; it changes no bit", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const auto run = [&](bool watched) {
    const Leaf leaf("swing", [=](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0, 0.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
      if (watched)
        l.declare_zero_crossing(
            {.name = "zero", .guard = [](const At& at, VectorRef out) { out = at.x; }, .size = 2});
    });
    return simulate(leaf, leaf.create_context(), {0.0, 7.0}, {.ode_solver_method = method});
  };
  const auto with = run(true), without = run(false);
  CHECK(with.events.size() == 4);  // cos: pi/2, 3 pi/2; -sin: pi, 2 pi, and not at the start
  CHECK(with.context.continuous_state() == without.context.continuous_state());
}

TEST_CASE("4.4 of a vector of guards each holds its own states, the others go on", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = balls(true);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0},
                                {.rtol = 1e-10, .atol = 1e-14, .ode_solver_method = method});
  std::vector<double> predicted;
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_enter)
      predicted.push_back(results.events[i].predicted);
  }
  REQUIRE(predicted.size() == n);
  for (std::size_t i = 0; i < n; ++i)  // 0.6, 0.9, 1.2, 1.5 s; known gap: adams and bdf to 1e-5
    CHECK_THAT(predicted[i], WithinAbs(BallExact{g, e, heights[i]}.rest(), 1e-5));
  CHECK(results.context.continuous_state().lpNorm<Eigen::Infinity>() < 1e-5);
}

TEST_CASE("4.4 without `holds` all of the leaf rests", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = balls(false);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 2.0},
                                {.rtol = 1e-10, .atol = 1e-14, .ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter) == 1);
  CHECK(results.context.continuous_state()[1] > 0.0);  // in mid-air, as it was at 0.6 s
}

TEST_CASE("2.1 a vector of guards that only ends the run says in the log which one did",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Index which = GENERATE(0, 1, 3);
  const int max_count = GENERATE(1, 2);
  INFO("method " << method << ", guard " << which << ", max_count " << max_count);
  const Leaf leaf("leaf", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0, 1.0}),
                                .ode = [](const At& at, VectorRef f) { f << at.x[1], -at.x[0]; }});
    l.declare_zero_crossing({.name = "end",
                             .guard =
                                 [=](const At& at, VectorRef out) {
                                   out.setConstant(-1.0);
                                   out[which] = at.x[0] - 0.5;
                                 },
                             .direction = Direction::negative_then_non_negative,
                             .terminal = true,
                             .max_count = max_count,
                             .size = n});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(results.status == Status::terminal);
  REQUIRE(results.events.size() == static_cast<std::size_t>(max_count));
  for (std::size_t i = 0; i < results.events.size(); ++i) CHECK(results.events[i].entry == which);
}
