// A fast oscillation, excited by the solution or not: which method "auto" takes, and whether the
// error stays within tolerances.
#include <numbers>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// y' = p' + A (y - p), A = [[-d, w], [-w, -d]], p = (sin t, cos t), from p(0): the solution is p,
/// and the modes -d +- i w are not excited.
Leaf beside(double w, double d) {
  return Leaf("beside", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}), .ode = [=](const At& at, VectorRef xdot) {
           const double s = std::sin(at.time), c = std::cos(at.time);
           const double a = at.x[0] - s, b = at.x[1] - c;
           xdot << c - d * a + w * b, -s - w * a - d * b;
         }});
  });
}

/// x'' = -w^2 x, in the states x and x'.
Leaf spring(double w) {
  return Leaf("spring", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [=](const At& at, VectorRef xdot) { xdot << at.x[1], -w * w * at.x[0]; }});
  });
}

Leaf kepler(double eccentricity) {
  return Leaf("kepler", [=](Leaf& l) {
    const double near = 1.0 - eccentricity;
    l.declare_continuous_state(
        {.initial = vec({near, 0.0, 0.0, std::sqrt((1.0 + eccentricity) / near)}),
         .ode = [](const At& at, VectorRef xdot) {
           const double r3 = std::pow(std::hypot(at.x[0], at.x[1]), 3);
           xdot << at.x[2], at.x[3], -at.x[0] / r3, -at.x[1] / r3;
         }});
  });
}

/// A ball that falls from 1 m onto a spring without damping.
Leaf contact(double stiffness) {
  return Leaf("contact", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], -9.81 - (at.mode == 1 ? stiffness * at.x[0] : 0.0);
         }});
    l.declare_default_mode(0);
    const auto height = [](const At& at) { return at.x[0]; };
    l.declare_zero_crossing({.name = "hit",
                             .guard = height,
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "leave",
                             .guard = height,
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = 1,
                             .end_mode = 0});
  });
}

/// The times of the first hits, in closed form: flights are parabolas, contacts parts of a sine.
std::vector<double> hits(double stiffness, std::size_t count) {
  const double g = 9.81, w = std::sqrt(stiffness), speed = std::sqrt(2.0 * g);
  const double touch = 2.0 / w * (std::numbers::pi - std::atan(speed * w / g));
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(std::sqrt(2.0 / g) + static_cast<double>(i) * (touch + 2.0 * speed / g));
  return times;
}

Results run(const Leaf& leaf, double t_end, Method method, double rtol, double atol) {
  return simulate(leaf, leaf.create_context(), {0.0, t_end},
                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
}

/// The error in tolerances of `beside` at t = 30.
double error_beside(const Results& results, double rtol) {
  const Eigen::Vector2d exact(std::sin(30.0), std::cos(30.0));
  return (results.context.continuous_state() - exact).cwiseAbs().maxCoeff() / rtol;
}

auto calls(const Results& results) { return results.statistics.right_hand_side_calls; }

bool explicit_only(const Results& results) {
  return results.statistics.stretches.size() == 1 && results.statistics.linear_setups == 0;
}

}  // namespace

// An error of ten tolerances is the aim of any method that suits a scene.
TEST_CASE(
    "auto beside a fast mode that is not excited is within ten tolerances, however little "
    "the mode is damped",
    "[laws][auto]") {
  const double w = GENERATE(30.0, 1000.0), d = GENERATE(0.0, 0.1, 1.0, 10.0);
  const double rtol = GENERATE(1e-3, 1e-4, 1e-6, 1e-8, 1e-10);
  const Leaf leaf = beside(w, d);
  const auto results = run(leaf, 30.0, Method::automatic, rtol, rtol);
  INFO("mode -" << d << " +- " << w << "i, rtol " << rtol << ": " << calls(results) << " calls, "
                << results.statistics.method);
  CHECK(error_beside(results, rtol) < 10.0);
}

TEST_CASE("auto beside a fast mode is within twenty tolerances in short slices", "[laws][auto]") {
  // The slices are shorter than the steps that would damp the mode. So what dopri5 has excited of
  // it stays: up to thresholds::damped_size.
  const double rtol = GENERATE(1e-3, 1e-4, 1e-6), slice = GENERATE(0.003, 0.02);
  const Leaf leaf = beside(1000.0, 0.0);
  Simulator simulator(leaf, {.rtol = rtol, .atol = rtol, .ode_solver_method = Method::automatic});
  simulator.initialize(leaf.create_context());
  for (int i = 1; slice * i < 3.0; ++i) simulator.advance_to(slice * i);
  const double end = simulator.context().time();
  const Eigen::Vector2d exact(std::sin(end), std::cos(end));
  INFO("rtol " << rtol << ", slices of " << slice << " s");
  CHECK((simulator.context().continuous_state() - exact).cwiseAbs().maxCoeff() < 20.0 * rtol);
}

TEST_CASE("auto beside a fast mode keeps to a largest step", "[laws][auto]") {
  const double rtol = GENERATE(1e-4, 1e-6), longest = GENERATE(0.001, 0.1);
  const Leaf leaf = beside(1000.0, 0.1);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 3.0},
                                {.rtol = rtol,
                                 .atol = rtol,
                                 .ode_solver_method = Method::automatic,
                                 .max_minor_step_size = longest});
  const Eigen::Vector2d exact(std::sin(3.0), std::cos(3.0));
  CHECK((results.context.continuous_state() - exact).cwiseAbs().maxCoeff() < 10.0 * rtol);
}

TEST_CASE("auto does not damp an oscillation that grows", "[laws][auto]") {
  // The deviation from p grows as exp(10 t); 3e-5 becomes 4.5e-3 at 0.5 s.
  Leaf leaf = beside(1000.0, -10.0);
  const auto start = leaf.create_context().with_continuous_state(vec({3e-5, 1.0}));
  const auto results =
      simulate(leaf, start, {0.0, 0.5},
               {.rtol = 1e-6, .atol = 1e-6, .ode_solver_method = Method::automatic});
  const Eigen::Vector2d slow(std::sin(0.5), std::cos(0.5));
  // Explicit methods make the amplitude wrong by a factor, for their errors grow too.
  const double deviation = (results.context.continuous_state() - slow).norm();
  CHECK(deviation > 4.5e-3 / 3.0);
  CHECK(deviation < 4.5e-3 * 10.0);
}

TEST_CASE("auto does not step at the pace of a fast mode that is not excited", "[laws][auto]") {
  const double w = GENERATE(1e3, 1e4, 1e5), d = GENERATE(0.1, 1.0, 10.0);
  const double rtol = GENERATE(1e-3, 1e-4, 1e-6);
  const Leaf leaf = beside(w, d);
  const auto results = run(leaf, 30.0, Method::automatic, rtol, rtol);
  INFO("mode -" << d << " +- " << w << "i, rtol " << rtol << ": " << results.statistics.method);
  // An explicit method needs 4.3 calls for each radian, 130 000 at w = 1000. Order 2 needs 30 s /
  // (rtol^(1/3) s), 3000 steps of 1.7 calls at rtol 1e-6.
  CHECK(calls(results) < 10000);
}

TEST_CASE("auto stays explicit where the solution itself oscillates, slow or fast, in any states",
          "[laws][auto]") {
  const double rtol = GENERATE(1e-3, 1e-4, 1e-6, 1e-8, 1e-10);
  const auto stays = [&](const Leaf& leaf, double t_end) {
    const auto results = run(leaf, t_end, Method::automatic, rtol, 1e-3 * rtol);
    INFO(leaf.name() << " to " << t_end << " s, rtol " << rtol << ": "
                     << results.statistics.method);
    CHECK(explicit_only(results));
  };
  for (const double w : {1.0, 100.0, 1e4}) stays(spring(w), 300.0 / w);
  for (const double eccentricity : {0.0, 0.5, 0.9}) stays(kepler(eccentricity), 60.0);
}

TEST_CASE("auto stays explicit in a contact without damping, and is as exact as that method",
          "[laws][auto]") {
  const double stiffness = GENERATE(1e5, 1e7, 1e9), rtol = GENERATE(1e-4, 1e-6, 1e-10);
  const Leaf leaf = contact(stiffness);
  const auto results = run(leaf, 4.0, Method::automatic, rtol, 1e-3 * rtol);
  INFO("stiffness " << stiffness << ", rtol " << rtol << ": " << results.statistics.method);
  CHECK(explicit_only(results));
  const auto found = results.events.times("hit");
  const auto exact = hits(stiffness, 4);
  REQUIRE(found.size() == exact.size());
  // Each contact changes the speed by ten tolerances at most, rtol v, so the next flight by 20
  // rtol v / g = 9 rtol [s]; the fourth hit sums three flights, of one, two and three such changes.
  CHECK(std::abs(found.back() - exact.back()) < 6.0 * 9.0 * rtol);
}

// Fixed-point iteration converges by h |lambda| beta, and its rest is multiplied by |lambda|.
TEST_CASE("adams beside a fast mode that is not excited is not carried away by its corrector",
          "[laws][adams]") {
  const double w = GENERATE(30.0, 1000.0), d = GENERATE(0.0, 0.1, 1.0);
  const double rtol = GENERATE(1e-4, 1e-6, 1e-8);
  const Leaf leaf = beside(w, d);
  const auto results = run(leaf, 30.0, Method::adams, rtol, rtol);
  INFO("mode -" << d << " +- " << w << "i, rtol " << rtol);
  // Orders above 2 are unstable on the imaginary axis, so that some tens of tolerances remain, 60
  // at worst; CVODE's own test left 20 000.
  CHECK(error_beside(results, rtol) < 100.0);
}
