// A derivative that jumps at the present state, with no guard to locate it: the run ends as
// chattering after some thousand steps, and no other run does.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

Leaf leaf_of(Eigen::VectorXd start, std::function<void(const At&, VectorRef)> ode) {
  return Leaf("leaf", [&](Leaf& l) { l.declare_continuous_state({.initial = start, .ode = ode}); });
}

/// A block with dry friction that a force moves to and fro: v = 0 while |force| < 1.
Leaf friction(double force, double start = 0.0) {
  return leaf_of(vec({0.0, start}), [=](const At& at, VectorRef xdot) {
    xdot << at.x[1], force * std::sin(at.time) - sign(at.x[1]);
  });
}

/// x' = -1 above a level that moves, +1 below: x slides along the level.
Leaf relay(double speed) {
  return leaf_of(vec({1.0}), [=](const At& at, VectorRef xdot) {
    xdot[0] = at.x[0] > speed * at.time ? -1.0 : 1.0;
  });
}

/// Two states that slide on a surface across both: x0 + x1 = 0.
Leaf across() {
  return leaf_of(vec({0.5, 0.3}), [](const At& at, VectorRef xdot) {
    const double s = sign(at.x[0] + at.x[1]);
    xdot << 1.0 - 2.0 * s, -1.0 - 3.0 * s;
  });
}

Results run(const Leaf& leaf, double t_end, Method method, double rtol = 1e-6) {
  return simulate(
      leaf, leaf.create_context(), {0.0, t_end},
      {.rtol = rtol, .atol = 1e-3 * rtol, .ode_solver_method = method, .throw_errors = false});
}

}  // namespace

TEST_CASE(
    "a solution that slides along a jump of its derivative ends as chattering, by every "
    "method",
    "[laws][crawl]") {
  const auto method = GENERATE(from_range(methods));
  const double rtol = GENERATE(1e-4, 1e-6, 1e-9);
  const auto ends = [&](const Leaf& leaf, const char* name) {
    const auto results = run(leaf, 10.0, method, rtol);
    INFO(name << ", " << method << ", rtol " << rtol << ": " << to_string(results.status) << " at "
              << results.context.time() << ", " << results.message);
    // A window of 1000 steps begins anew at most once before the slide. A run that needs no more
    // may end: with large tolerances some steps pass the jump.
    CHECK(results.statistics.steps < 4000);
    CHECK(results.statistics.right_hand_side_calls < 100000);
    if (rtol > 1e-5 && results.status == Status::reached_end) return;
    CHECK(results.status == Status::chattering);
    CHECK(contains(results.message, "block 'leaf' jumps from"));
  };
  ends(friction(1.2), "friction");
  ends(friction(0.5, 1.0), "friction that stops");
  ends(relay(0.0), "relay");
  ends(relay(0.1), "moving relay");
  ends(across(), "surface across two states");
}

TEST_CASE("a jump that is passed, in the state or in time, is no chattering", "[laws][crawl]") {
  const auto method = GENERATE(from_range(methods));
  const auto reaches = [&](const Leaf& leaf, double t_end, const char* name) {
    const auto results = run(leaf, t_end, method);
    INFO(name << ", " << method << ": " << results.message);
    CHECK(results.status == Status::reached_end);
  };
  // Its friction is less than its force wherever it turns, so that it never rests.
  reaches(leaf_of(vec({1.0, 0.0}),
                  [](const At& at, VectorRef xdot) {
                    xdot << at.x[1],
                        -100.0 * at.x[0] + 20.0 * std::cos(10.0 * at.time) - 0.1 * sign(at.x[1]);
                  }),
          20.0, "oscillator with friction");
  reaches(leaf_of(vec({0.0}),
                  [](const At& at, VectorRef xdot) { xdot[0] = sign(std::sin(50.0 * at.time)); }),
          10.0, "square wave");
}

TEST_CASE("a steep derivative is no jump", "[laws][crawl]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic, Method::bdf);
  const double width = GENERATE(1e-2, 1e-4, 1e-6);
  // dopri5 takes 1 / (3 width) steps for each second; its derivative changes sign in each of them.
  const Leaf leaf = leaf_of(vec({0.0, 0.0}), [=](const At& at, VectorRef xdot) {
    xdot << at.x[1], 0.5 * std::sin(at.time) - std::tanh(at.x[1] / width);
  });
  const auto results = run(leaf, 0.1, method);
  INFO(method << ", width " << width << ": " << results.message);
  CHECK(results.status == Status::reached_end);
}

TEST_CASE("short steps of a scene without a jump are no chattering", "[laws][crawl]") {
  const auto method = GENERATE(Method::dopri5, Method::adams);
  // 30 000 steps at the limit of stability, in each of which the derivative changes sign.
  const Leaf leaf = leaf_of(vec({1.0}), [](const At& at, VectorRef xdot) {
    xdot[0] = 1e5 * (std::cos(at.time) - at.x[0]);
  });
  CHECK(run(leaf, 1.0, method).status == Status::reached_end);
}

TEST_CASE("a look ahead for a jump may leave the domain of the derivative", "[laws][crawl]") {
  const auto method = GENERATE(Method::dopri5, Method::bdf);
  // x = 1e-3 sin(1000 t), in steps of some 1e-4 s. Eight of them straight on lead beyond 1.05e-3.
  const Leaf leaf = leaf_of(vec({0.0}), [](const At& at, VectorRef xdot) {
    if (at.x[0] > 1.05e-3) throw std::domain_error("x is too large");
    xdot[0] = std::cos(1e3 * at.time);
  });
  CHECK(run(leaf, 2.0, method).status == Status::reached_end);
}
