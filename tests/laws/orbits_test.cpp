// periodic_orbit and period_map: orbits with known periods and multipliers, and refusals.
#include <cmath>
#include <complex>

#include "saltus/analysis/period_map.hpp"
#include "saltus/analysis/periodic_orbit.hpp"
#include "saltus/library/library.hpp"
#include "saltus/model/equations.hpp"
#include "saltus/models/rimless_wheel.hpp"
#include "saltus/models/thermostat.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace orbits_test {

/// x'' = mu (1 - x^2) x' - x.
Leaf oscillator() {
  return Leaf("oscillator", [](Leaf& leaf) {
    const ParameterIndex mu = leaf.declare_dynamic_parameter("mu", 1.0);
    leaf.declare_continuous_state(
        {.initial = vec({2.0, 0.0}), .ode = equations<2>([mu](const auto& at, auto& xdot) {
                                       xdot[0] = at.x(1);
                                       xdot[1] = at.p(mu, 0) * (1.0 - at.x(0) * at.x(0)) * at.x(1) -
                                                 at.x(0);
                                     })});
  });
}

/// A room between `low` and `high` that are parameters: T' = (40 - T) / 1800 with the heater on,
/// (10 - T) / 1800 with it off.
Leaf room() {
  return Leaf("room", [](Leaf& leaf) {
    const ParameterIndex low = leaf.declare_dynamic_parameter("low", 19.0);
    const ParameterIndex high = leaf.declare_dynamic_parameter("high", 21.0);
    const ParameterIndex heater = leaf.declare_dynamic_parameter("heater", 40.0);
    leaf.declare_continuous_state({.initial = vec({19.0}), .ode = [heater](const At& at) {
                                     return ((at.mode == 1 ? at.p[heater] : 10.0) - at.x[0]) /
                                            1800.0;
                                   }});
    leaf.declare_default_mode(1);
    leaf.declare_zero_crossing({.name = "warm",
                                .guard = [high](const At& at) { return at.x[0] - at.p[high]; },
                                .direction = Direction::negative_then_non_negative,
                                .start_mode = 1,
                                .end_mode = 0});
    leaf.declare_zero_crossing({.name = "cold",
                                .guard = [low](const At& at) { return at.x[0] - at.p[low]; },
                                .direction = Direction::positive_then_non_positive,
                                .start_mode = 0,
                                .end_mode = 1});
  });
}

std::string refusal(const System& system, const PeriodicOrbitOptions& options) {
  return message<Error>([&] { periodic_orbit(system, system.create_context(), options); });
}

TEST_CASE("a rimless wheel keeps the part 1/2 of a deviation in each step", "[orbits]") {
  const Scene wheel = models::rimless_wheel();
  for (const int steps : {1, 2}) {
    PeriodicOrbitOptions options{.section = "wheel.spoke", .firings = steps};
    const PeriodicOrbit orbit = periodic_orbit(*wheel.system, wheel.context, options);
    REQUIRE(orbit.success());
    CHECK(orbit.stable() == true);
    // omega^2 = 4 sin(slope) sin(alpha); the multiplier is cos^2(2 alpha) in each step. rtol = 1e-10
    // over a step, whose sensitivity to the rate is of order 10
    CHECK_THAT(orbit.x0[1], WithinAbs(0.34975436743250965, 1e-9));
    REQUIRE(orbit.multipliers.size() == 1);
    CHECK_THAT(orbit.multipliers[0].real(), WithinAbs(std::pow(0.5, steps), 1e-8));
    CHECK_THAT(orbit.trivial, WithinAbs(1.0, 1e-7));
    CHECK(orbit.results.events.times("spoke").size() <= static_cast<std::size_t>(steps));
  }
}

TEST_CASE("Van der Pol's oscillator has its period and the multiplier of its divergence",
          "[orbits]") {
  const Leaf leaf = oscillator();
  PeriodicOrbitOptions options{.wrt = {"mu"}};
  const PeriodicOrbit orbit = periodic_orbit(leaf, leaf.create_context(), options);
  REQUIRE(orbit.success());
  CHECK_THAT(orbit.period, WithinAbs(6.6632868593, 1e-9));
  // the product of all multipliers is exp(integral of the divergence 1 - x^2), by Simpson's rule
  double integral = 0.0;
  const int n = 2000;
  for (int i = 0; i <= n; ++i) {
    const double x =
        orbit.results.at(orbit.context.time() + orbit.period * i / n).continuous_state[0];
    integral += (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * (1.0 - x * x);
  }
  CHECK_THAT(orbit.multipliers[0].real(),
             WithinRel(std::exp(integral * orbit.period / n / 3.0), 1e-5));  // absolute 1e-8
  // the period by mu, by two orbits: h^2 of the third derivative, and 1e-9 / h
  const double h = 1e-3;
  const auto period = [&](double mu) {
    return periodic_orbit(leaf, orbit.context.with_parameter("mu", mu)).period;
  };
  CHECK_THAT(orbit.dperiod("mu"), WithinAbs((period(1.0 + h) - period(1.0 - h)) / (2.0 * h), 1e-5));
  CHECK(contains(message<ModelError>([&] { orbit.dperiod("nu"); }), "did you mean 'mu'?"));
}

TEST_CASE("a thermostat forgets its start, and its period has known derivatives", "[orbits]") {
  const Leaf leaf = room();
  PeriodicOrbitOptions options{.section = "cold", .wrt = {"low", "high", "heater"}};
  const PeriodicOrbit orbit = periodic_orbit(leaf, leaf.create_context(), options);
  REQUIRE(orbit.success());
  CHECK(orbit.multipliers.size() == 0);  // one state, and the flow is along it
  // tau ln(21/19 11/9), and its derivatives in closed form
  CHECK_THAT(orbit.period, WithinRel(541.3574772344409, 1e-9));
  CHECK_THAT(orbit.dperiod("low"), WithinRel(-285.7142857142857, 1e-6));
  CHECK_THAT(orbit.dperiod("high"), WithinRel(258.3732057413268, 1e-6));
  CHECK_THAT(orbit.dperiod("heater"), WithinRel(-9.022556390977442, 1e-6));
  CHECK_THAT(orbit.dx0("low")[0], WithinAbs(1.0, 1e-6));
  CHECK_THAT(orbit.x0[0], WithinAbs(19.0, 1e-8));
}

TEST_CASE("a driven lag has its orbit at a fixed period", "[orbits]") {
  // x' = -x + cos(2 pi t): x = (cos + 2 pi sin) / (1 + 4 pi^2), with the multiplier exp(-1)
  const double w = 6.283185307179586;
  const Leaf lag("lag", [w](Leaf& leaf) {
    const ParameterIndex gain = leaf.declare_dynamic_parameter("gain", 1.0);
    leaf.declare_continuous_state({.initial = vec({3.0}), .ode = [=](const At& at) {
                                     return at.p[gain] * std::cos(w * at.time) - at.x[0];
                                   }});
  });
  PeriodicOrbitOptions options{.period = 1.0, .wrt = {"gain"}};
  const PeriodicOrbit orbit = periodic_orbit(lag, lag.create_context(), options);
  REQUIRE(orbit.success());
  CHECK_THAT(orbit.x0[0], WithinAbs(1.0 / (1.0 + w * w), 1e-9));
  CHECK_THAT(orbit.multipliers[0].real(), WithinRel(std::exp(-1.0), 1e-8));
  CHECK(std::isnan(orbit.trivial));
  CHECK(orbit.dperiod("gain") == 0.0);
  CHECK_THAT(orbit.dx0("gain")[0], WithinAbs(1.0 / (1.0 + w * w), 1e-7));
  CHECK(contains(refusal(lag, {.period = 0.7}), "no period of the drive"));
  CHECK(contains(refusal(lag, {}), "the time moves the system"));
}

TEST_CASE("bad arguments of periodic_orbit are refused by name", "[orbits]") {
  const Leaf leaf = room();
  CHECK(contains(refusal(leaf, {.section = "cold", .period = 1.0}), "found both"));
  CHECK(contains(refusal(leaf, {.section = "coldd"}), "did you mean 'cold'?"));
  CHECK(contains(refusal(leaf, {.firings = 2}), "counts those of a section"));
  CHECK(contains(refusal(leaf, {.section = "cold", .max_period = 100.0}),
                 "has fired 0 of 2 times since t = 0 s"));
  CHECK(contains(refusal(leaf, {.section = "cold", .wrt = {"lo"}}), "did you mean 'low'?"));
  CHECK(contains(refusal(leaf, {.section = "cold", .wrt = {"x[0]"}}), "is a start value"));
  CHECK(
      contains(refusal(leaf, {.section = "cold", .tolerance = 0.0}), "expected a positive number"));
  PeriodicOrbitOptions own{.section = "cold"};
  own.simulation.dense_output = true;
  CHECK(contains(refusal(leaf, own), "the option 'dense_output' is set by it"));
}

/// r' = r (1 - r^2), at the rate 1 around 0: a stable circle of radius 1. `crossed` looks at x = 0.
template <class Reset>
Leaf turning(Reset reset, double side = 0.0, bool terminal = false) {
  return Leaf("turning", [&](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({0.5, 0.1}), .ode = [](const At& at, VectorRef xdot) {
           const double x = at.x[0], y = at.x[1], pull = 1.0 - x * x - y * y;
           xdot << pull * x - y, pull * y + x;
         }});
    leaf.declare_discrete_state(vec({side}));
    leaf.declare_default_mode(0);
    leaf.declare_zero_crossing({.name = "crossed",
                                .guard = [](const At& at) { return at.x[0]; },
                                .reset_map = reset,
                                .direction = Direction::negative_then_non_negative,
                                .terminal = terminal});
  });
}

TEST_CASE("a deviation of a circle shrinks to exp(-4 pi) in a turn", "[orbits]") {
  const Leaf leaf = turning(ResetMap());
  const PeriodicOrbit orbit = periodic_orbit(leaf, leaf.create_context(), {.section = "crossed"});
  REQUIRE(orbit.success());
  CHECK_THAT(orbit.period, WithinAbs(6.283185307179586, 1e-8));
  CHECK((orbit.x0 - Eigen::Vector2d(0.0, -1.0)).norm() < 1e-8);
  CHECK_THAT(orbit.multipliers[0].real(), WithinAbs(std::exp(-12.566370614359172), 1e-8));
  CHECK(orbit.stable() == true);
}

TEST_CASE("what does not return is named, and a side returns after two firings", "[orbits]") {
  const Leaf counts =
      turning([](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); });
  CHECK(contains(refusal(counts, {.section = "crossed"}),
                 "the discrete state 'z[0]' did not return"));
  const Leaf modes = turning([](const At& at, Next& next) { next.set_mode(at.mode + 1); });
  CHECK(contains(refusal(modes, {.section = "crossed"}), "the mode of 'turning' did not return"));
  const Leaf sides =
      turning([](const At& at, Next& next) { next.set_discrete_state({-at.z[0]}); }, 1.0);
  CHECK(contains(refusal(sides, {.section = "crossed"}), "did not return"));
  const PeriodicOrbit orbit =
      periodic_orbit(sides, sides.create_context(), {.section = "crossed", .firings = 2});
  CHECK_THAT(orbit.period, WithinAbs(12.566370614359172, 1e-7));
  CHECK(orbit.multipliers.size() == 1);  // that of the side is none
  const Leaf ends = turning(ResetMap(), 0.0, true);
  CHECK(contains(refusal(ends, {.section = "crossed"}), "with the status 'terminal'"));
}

TEST_CASE("a search that does not converge, or has no derivative, says so", "[orbits]") {
  const Scene wheel = models::rimless_wheel();
  const PeriodicOrbit orbit =
      periodic_orbit(*wheel.system, wheel.context, {.section = "wheel.spoke", .max_iterations = 1});
  CHECK(orbit.status == SearchStatus::max_iterations);
  CHECK(contains(orbit.message, "after 1 steps"));
  CHECK(std::isnan(orbit.multipliers[0].real()));
  CHECK(!orbit.stable());
  CHECK(contains(message<SimulationError>([&] { orbit.dperiod("e"); }), "no orbit was found"));
  // a guard that shows a sign only says nothing about the time at which it crosses
  const Leaf sign("sign", [](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({0.5, 0.1}),
         .ode = [](const At& at, VectorRef xdot) { xdot << -at.x[1], at.x[0]; }});
    leaf.declare_zero_crossing({.name = "sign",
                                .guard = [](const At& at) { return at.x[0] > 0.3 ? 1.0 : -1.0; },
                                .direction = Direction::negative_then_non_negative});
  });
  CHECK(contains(refusal(sign, {.section = "sign"}),
                 "there is no derivative by 'x[0]' at the event"));
  const Leaf falls("falls", [](Leaf& leaf) { declare_ramp(leaf); });
  CHECK(contains(refusal(falls, {.max_period = 10.0}), "came close to none"));
}

// The numbers of the Python module:
//   o = saltus.periodic_orbit(saltus.system_of(lambda t, x, mu: [x[1], mu * (1 - x[0]**2) * x[1] - x[0]],
//       [2.0, 0.0], parameters={"mu": 1.0}), wrt=["mu"])
//   print(o.x0, o.period, o.multipliers, o.dperiod("mu"))
//   w = saltus.scene("rimless-wheel"); o = saltus.periodic_orbit(w.system, w.context, "wheel.spoke")
//   print(o.x0, o.period, o.multipliers)
TEST_CASE("periodic_orbit has the values that the Python module has", "[orbits]") {
  const Leaf leaf = oscillator();
  PeriodicOrbitOptions by_mu{.wrt = {"mu"}};
  const PeriodicOrbit smooth = periodic_orbit(leaf, leaf.create_context(), by_mu);
  CHECK_THAT(smooth.period, WithinAbs(6.663286859321129, 1e-9));
  CHECK_THAT(smooth.multipliers[0].real(), WithinAbs(0.00085969507649616, 1e-8));
  CHECK_THAT(smooth.dperiod("mu"), WithinAbs(0.7315965977788205, 1e-7));
  const Scene wheel = models::rimless_wheel();
  const PeriodicOrbit walk =
      periodic_orbit(*wheel.system, wheel.context, {.section = "wheel.spoke"});
  CHECK_THAT(walk.x0[0], WithinAbs(-0.3126990816987241, 1e-9));
  CHECK_THAT(walk.x0[1], WithinAbs(0.34975436743087207, 1e-9));
  CHECK_THAT(walk.period, WithinAbs(3.2403051388963324, 1e-8));
  CHECK_THAT(walk.multipliers[0].real(), WithinAbs(0.49999999984789906, 1e-8));
}

constexpr double tick = 0.4;
const Eigen::Vector2d gains(0.8, 1.1);

/// A double integrator, whose force z = r - K x is computed at each tick; z[1] counts the ticks.
Leaf sampled() {
  return Leaf("loop", [](Leaf& leaf) {
    const ParameterIndex r = leaf.declare_dynamic_parameter("r", 0.0);
    leaf.declare_continuous_state(
        {.initial = vec({0.3, -0.2}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], at.z[0]; }});
    leaf.declare_discrete_state(vec({0.0, 0.0}));
    leaf.declare_periodic_update(
        [r](const At& at, Next& next) {
          next.set_discrete_state(
              {at.p[r] - gains[0] * at.x[0] - gains[1] * at.x[1], at.z[1] + 1.0});
        },
        tick, 0.0);
    leaf.declare_output_port({.name = "energy", .calc = [r](const At& at) {
                                return 0.5 * at.x[1] * at.x[1] + at.x[0] * at.p[r] + 3.0 * at.z[0];
                              }});
  });
}

TEST_CASE("the map of a sampled double integrator is that of its matrices", "[orbits]") {
  const Leaf leaf = sampled();
  PeriodMapOptions options{.inputs = {"r"}, .outputs = {{{"energy", leaf.output("energy")}}}};
  const PeriodMap map = period_map(leaf, leaf.create_context(), tick, options);
  const Eigen::Matrix2d a{{1.0, tick}, {0.0, 1.0}};
  const Eigen::Vector2d b(0.5 * tick * tick, tick);
  Eigen::Matrix3d phi;
  phi << a, b, -gains.transpose() * a, -gains.dot(b);
  CHECK((map.Phi - phi).cwiseAbs().maxCoeff() < 1e-8);  // rtol = 1e-10
  CHECK((map.Gamma - Eigen::Vector3d(0.0, 0.0, 1.0)).cwiseAbs().maxCoeff() < 1e-8);
  CHECK(map.states == std::vector<std::string>{"x[0]", "x[1]", "z[0]"});
  REQUIRE(map.frozen.size() == 1);
  CHECK(map.frozen[0].name == "z[1]");
  CHECK((map.x0 - Eigen::Vector3d(0.3, -0.2, -0.24 + 0.22)).norm() < 1e-14);
  CHECK((map.x1 - phi * map.x0).norm() < 1e-8);
  // the force is a function of the state, so its multiplier is 0
  const Eigen::Matrix2d loop = a - b * gains.transpose();
  CHECK_THAT(std::abs(map.multipliers()[0]),
             WithinAbs(std::sqrt(loop(0, 0) * loop(1, 1) - loop(0, 1) * loop(1, 0)), 1e-8));
  CHECK_THAT(std::abs(map.multipliers()[2]), WithinAbs(0.0, 1e-8));
  CHECK(map.stability() == Stability::stable);
  CHECK(!map.is_fixed_point());
  // d(v^2/2 + x r + 3 z) by the state after the instant
  CHECK((map.C - Eigen::RowVector3d(0.0, -0.2, 3.0)).norm() < 1e-12);
  CHECK_THAT(map.D(0, 0), WithinAbs(0.3, 1e-12));
  CHECK(map.outputs == std::vector<std::string>{"energy"});
  const PeriodMap two = period_map(leaf, leaf.create_context(), 2.0 * tick);
  CHECK((two.Phi - map.Phi * map.Phi).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("period_map refuses what is no period, no parameter, no positive time", "[orbits]") {
  const Leaf leaf = sampled();
  const auto refused = [&](double period, const PeriodMapOptions& options = {}) {
    return message<ModelError>([&] { period_map(leaf, leaf.create_context(), period, options); });
  };
  CHECK(contains(refused(0.3), "no period of the clocks"));
  CHECK(contains(refused(-1.0), "expected a positive time"));
  CHECK(contains(refused(tick, {.inputs = {"x[0]"}}), "is a state"));
  CHECK(contains(refused(tick, {.inputs = {"rr"}}), "did you mean 'r'?"));
}

}  // namespace orbits_test
