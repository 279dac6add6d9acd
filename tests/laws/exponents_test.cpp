// lyapunov: exponents by closed forms, smooth and through events, and refusals.
#include <cmath>

#include "saltus/analysis/lyapunov.hpp"
#include "saltus/analysis/periodic_orbit.hpp"
#include "saltus/model/equations.hpp"
#include "saltus/models/bouncing_ball.hpp"
#include "saltus/models/lorenz.hpp"
#include "saltus/models/rimless_wheel.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace exponents_test {

/// dx/dt = A x.
Leaf linear(const Eigen::MatrixXd& a, const Eigen::VectorXd& start) {
  return Leaf("linear", [&](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = start, .ode = [a](const At& at, VectorRef xdot) { xdot = a * at.x; }});
  });
}

/// u'' - 2 b u' + (w^2 + b^2)(u - s) = 0, and s becomes the sign of u where u' = 0.
Leaf solvable(double b) {
  return Leaf("oscillator", [b](Leaf& leaf) {
    const double stiffness = 39.47841760435743 + b * b;  // w = 2 pi
    leaf.declare_continuous_state(
        {.initial = vec({0.4, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], 2.0 * b * at.x[1] - stiffness * (at.x[0] - at.z[0]);
         }});
    leaf.declare_discrete_state(vec({1.0}));
    leaf.declare_zero_crossing(
        {.name = "top",
         .guard = [](const At& at) { return at.x[1]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_discrete_state({at.x[0] >= 0.0 ? 1.0 : -1.0}); },
         .direction = Direction::crosses_zero});
  });
}

/// A ball that falls from 1 m and keeps half of its speed.
class Fallen final : public LeafSystem {
 public:
  explicit Fallen(std::string name) : LeafSystem(std::move(name)) {
    declare_continuous_state({.initial = vec({1.0, 0.0}),
                              .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    declare_zero_crossing(
        {.name = "hit",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({0.0, -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  }
};

std::string refusal(const System& system, const LyapunovOptions& options) {
  return message<ModelError>([&] { lyapunov(system, system.create_context(), options); });
}

TEST_CASE("the sum of Lorenz' exponents is the divergence of the flow", "[exponents]") {
  const Scene scene = models::lorenz();
  const LyapunovSpectrum found =
      lyapunov(*scene.system, scene.context, {.time = 200.0, .transient = 20.0});
  // the determinant of each piece has the error of its derivatives, some 1e-9 a second
  CHECK_THAT(found.sum(), WithinRel(-41.0 / 3.0, 1e-8));
  // known digits; a deviation of four standard errors happens once in 1e4 times
  const double known[] = {0.9056, 0.0, -14.572};
  for (int k = 0; k < 3; ++k)
    CHECK(std::abs(found.exponents[k] - known[k]) <= 4.0 * found.errors[k] + 1e-3);
  CHECK(found.dimension() > 2.03);
  CHECK(found.dimension() < 2.09);
  CHECK(found.states == std::vector<std::string>{"x[0]", "x[1]", "x[2]"});
  const LyapunovSpectrum one =
      lyapunov(*scene.system, scene.context, {.time = 50.0, .transient = 20.0, .count = 1});
  CHECK(one.exponents.size() == 1);
  CHECK(std::abs(one.exponents[0] - 0.9056) <= 4.0 * one.errors[0] + 1e-3);
}

TEST_CASE("a linear system has the real parts of its poles", "[exponents]") {
  const Leaf leaf = linear(Eigen::Matrix3d{{-0.3, 2.0, 0.4}, {-2.0, -0.3, 0.1}, {0.0, 0.0, -1.5}},
                           vec({1.0, 0.0, 1.0}));
  const LyapunovSpectrum found = lyapunov(leaf, leaf.create_context(), {.time = 200.0});
  // the directions turn by a bounded amount: its logarithm over 180 s is below 2e-3
  CHECK_THAT(found.exponents[0], WithinAbs(-0.3, 2e-3));
  CHECK_THAT(found.exponents[1], WithinAbs(-0.3, 2e-3));
  CHECK_THAT(found.exponents[2], WithinAbs(-1.5, 2e-3));
  CHECK_THAT(found.sum(), WithinRel(-2.1, 1e-6));
  CHECK(found.dimension() == 0.0);
}

TEST_CASE("directions that grow apart fast have short pieces", "[exponents]") {
  const Leaf saddle = linear(Eigen::Matrix2d{{4.0, 1.0}, {0.0, -16.0}}, vec({0.0, 0.0}));
  const LyapunovSpectrum found =
      lyapunov(saddle, saddle.create_context(), {.time = 30.0, .every = 30.0});
  CHECK_THAT(found.exponents[0], WithinRel(4.0, 1e-6));
  CHECK_THAT(found.exponents[1], WithinRel(-16.0, 1e-6));
  CHECK(found.converged);
  const Index n = found.times.size();
  CHECK((found.times.tail(n - 1) - found.times.head(n - 1)).maxCoeff() < 1.0);
}

TEST_CASE("a rimless wheel has the logarithm of its multiplier over its period", "[exponents]") {
  const Scene wheel = models::rimless_wheel();
  const LyapunovSpectrum found =
      lyapunov(*wheel.system, wheel.context, {.time = 1000.0, .transient = 100.0});
  const double period = periodic_orbit(*wheel.system, wheel.context, {.section = "spoke"}).period;
  // the time that counts is no whole number of periods: bounded terms over 900 s
  CHECK_THAT(found.exponents[0], WithinAbs(0.0, 4e-3));
  CHECK_THAT(found.exponents[1], WithinAbs(std::log(0.5) / period, 4e-3));
}

TEST_CASE("a solvable chaotic oscillator with a switch has the exponents b and 0", "[exponents]") {
  // N. Corron, J. Blakely, M. Stahl, Chaos 20 (2010) 023123: the flow has the divergence 2 b, so the
  // jumps of the derivative at the switches take b away
  const Leaf leaf = solvable(0.5);
  const LyapunovSpectrum found =
      lyapunov(leaf, leaf.create_context(), {.time = 200.0, .transient = 10.0});
  CHECK(std::abs(found.exponents[0] - 0.5) <= 4.0 * found.errors[0] + 1e-6);
  CHECK(std::abs(found.exponents[1]) <= 4.0 * found.errors[1] + 1e-6);
  CHECK(found.states == std::vector<std::string>{"x[0]", "x[1]"});
  REQUIRE(found.frozen.size() == 1);
  CHECK(found.frozen[0].name == "z[0]");
}

TEST_CASE("each impact of a ball on a table has the determinant of e squared", "[exponents]") {
  // flight keeps the volume, so sum T = 2 n ln(e) with the number n of impacts
  const double e = 0.8, a = 0.05, w = 40.0;
  const Leaf ball("ball", [=](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({0.5, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    leaf.declare_zero_crossing(
        {.name = "hit",
         .guard = [=](const At& at) { return at.x[0] - a * std::sin(w * at.time); },
         .reset_map =
             [=](const At& at, Next& next) {
               const double table = a * w * std::cos(w * at.time);
               next.set_continuous_state({at.x[0], (1.0 + e) * table - e * at.x[1]});
             },
         .direction = Direction::positive_then_non_positive});
  });
  const LyapunovSpectrum found =
      lyapunov(ball, ball.create_context(), {.time = 60.0, .transient = 10.0});
  const double span = found.times[found.times.size() - 1] - found.begin;
  const double impacts = found.sum() * span / (2.0 * std::log(e));
  CHECK_THAT(impacts, WithinAbs(std::round(impacts), 1e-5));  // each has an error of 1e-8 or less
  CHECK(impacts > 10.0);
  CHECK(found.exponents[0] > 4.0 * found.errors[0]);  // chaotic
}

TEST_CASE("a sampled map has its exponent, and an update forgets a direction", "[exponents]") {
  // z -> 4 z (1 - z) each second, and a count; x' = z - x / 10. The first z is whole, and no label
  const Leaf map("map", [](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({0.0}), .ode = [](const At& at) { return at.z[0] - 0.1 * at.x[0]; }});
    leaf.declare_discrete_state(vec({0.0, 0.0}));
    leaf.declare_periodic_update(
        [](const At& at, Next& next) {
          const double z = at.z[1] > 0.0 ? 4.0 * at.z[0] * (1.0 - at.z[0]) : 0.3;
          next.set_discrete_state({z, at.z[1] + 1.0});
        },
        1.0, 0.0);
  });
  const LyapunovSpectrum found =
      lyapunov(map, map.create_context(), {.time = 1000.0, .every = 1.0});
  CHECK(std::abs(found.exponents[0] - std::log(2.0)) <= 4.0 * found.errors[0] + 1e-6);
  CHECK_THAT(found.exponents[1], WithinAbs(-0.1, 4.0 * found.errors[1] + 1e-3));
  CHECK(found.states == std::vector<std::string>{"x[0]", "z[0]"});
  REQUIRE(found.frozen.size() == 1);
  CHECK(found.frozen[0].value == 1001.0);
  const Leaf loop("loop", [](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({1.0, 0.5}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], at.z[0]; }});
    leaf.declare_discrete_state(vec({0.0}));
    leaf.declare_periodic_update(
        [](const At& at, Next& next) { next.set_discrete_state({-0.8 * at.x[0] - 1.1 * at.x[1]}); },
        0.4, 0.0);
  });
  const LyapunovSpectrum three = lyapunov(loop, loop.create_context(), {.time = 100.0});
  CHECK(three.exponents[2] == -infinite);
  CHECK(three.errors[2] == 0.0);
  // |multiplier|^2 is the determinant of A - B K = 1 - 0.44 + 0.064; rotating directions: a bounded
  // logarithm over 90 s
  const double pair = 0.5 * std::log(1.0 - 1.1 * 0.4 + 0.8 * 0.08) / 0.4;
  CHECK_THAT(three.exponents[0], WithinAbs(pair, 0.02));
  CHECK_THAT(three.exponents[1], WithinAbs(pair, 0.02));
}

TEST_CASE("a ball that comes to rest has no exponents", "[exponents]") {
  const Scene scene = models::bouncing_ball();
  const auto refused = [&](const LyapunovOptions& options) {
    return message<Error>([&] { lyapunov(*scene.system, scene.context, options); });
  };
  CHECK(contains(refused({.time = 60.0}), "came to rest after 'ball.bounce'"));
  CHECK(contains(refused({.time = 10.0, .transient = 40.0}), "'x[0]', 'x[1]' is at rest"));
  DiagramBuilder builder;
  builder.add<Fallen>("a"), builder.add<Fallen>("b");
  const Diagram two = builder.build();
  LyapunovOptions options{.time = 20.0};
  options.simulation.islands = true;
  CHECK(contains(message<Error>([&] { lyapunov(two, two.create_context(), options); }),
                 "'state 0 of island 0', 'state 1 of island 0'"));
}

TEST_CASE("bad arguments of lyapunov are refused by name", "[exponents]") {
  const Leaf leaf = linear(Eigen::MatrixXd::Constant(1, 1, -1.0), vec({1.0}));
  CHECK(contains(refusal(leaf, {}), "time: expected a positive number, found 0"));
  CHECK(contains(refusal(leaf, {.time = 1.0, .transient = -1.0}), "transient"));
  CHECK(contains(refusal(leaf, {.time = 1.0, .count = 2}), "expected an integer from 1 to 1"));
  CHECK(contains(refusal(leaf, {.time = 1.0, .tolerance = not_a_number}), "tolerance"));
  const Leaf none("none", [](Leaf& l) {
    l.declare_output_port({.name = "y", .calc = [](const At&) { return 1.0; }});
  });
  CHECK(contains(refusal(none, {.time = 1.0}), "has no states"));
}

// The numbers of the Python module:
//   m = np.array([[-0.3, 2.0, 0.4], [-2.0, -0.3, 0.1], [0.0, 0.0, -1.5]])
//   f = saltus.lyapunov(saltus.system_of(lambda t, x: list(m @ x), [1.0, 0.0, 1.0]), time=200.0)
//   print(f.exponents, f.errors)
//   f = saltus.lyapunov(saltus.system_of(lambda t, x: [-0.3 * x[0] + 2 * np.cos(t)], [3.0]), time=50.0)
//   print(f.exponents)
TEST_CASE("lyapunov has the values that the Python module has", "[exponents]") {
  const Leaf driven("driven", [](Leaf& leaf) {
    leaf.declare_continuous_state({.initial = vec({3.0}), .ode = [](const At& at) {
                                     return -0.3 * at.x[0] + 2.0 * std::cos(at.time);
                                   }});
  });
  const LyapunovSpectrum found = lyapunov(driven, driven.create_context(), {.time = 50.0});
  CHECK_THAT(found.exponents[0], WithinAbs(-0.3000000000000058, 1e-8));
  const Leaf leaf = linear(Eigen::Matrix3d{{-0.3, 2.0, 0.4}, {-2.0, -0.3, 0.1}, {0.0, 0.0, -1.5}},
                           vec({1.0, 0.0, 1.0}));
  const LyapunovSpectrum three = lyapunov(leaf, leaf.create_context(), {.time = 200.0});
  // the first directions are others, and turn by a bounded amount
  CHECK_THAT(three.exponents[0], WithinAbs(-0.2999999588650435, 2e-3));
  CHECK_THAT(three.exponents[1], WithinAbs(-0.2999999588650844, 2e-3));
  CHECK_THAT(three.exponents[2], WithinAbs(-1.499999975705825, 2e-3));
  CHECK_THAT(three.sum(), WithinAbs(-2.099999893435953, 1e-6));
}

}  // namespace exponents_test
