// linearize: matrices by hand, the sides of relations, and every refusal.
#include "saltus/simulation/linearize.hpp"

#include <cmath>

#include "saltus/library/library.hpp"
#include "saltus/model/equations.hpp"
#include "saltus/models/bouncing_ball.hpp"
#include "saltus/simulation/simulate.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A pendulum: angle' = omega, omega' = -(g / l) sin(angle) - c omega + u, y = sin(angle) + 2 u.
/// `traced`: as a formula, which has exact derivatives.
Leaf pendulum(bool traced) {
  return Leaf("pendulum", [traced](Leaf& leaf) {
    leaf.declare_input_port({.name = "u"});
    const ParameterIndex c = leaf.declare_dynamic_parameter("c", 0.3);
    const auto ode = equations<2>([c](const auto& at, auto& xdot) {
      using std::sin;
      xdot[0] = at.x(1);
      xdot[1] = -9.81 * sin(at.x(0)) - at.p(c, 0) * at.x(1) + at.u(0, 0);
    });
    ContinuousState state{.initial = vec({0.5, 0.2}), .names = {"angle", "omega"}};
    if (traced)
      state.ode = ode;
    else
      state.ode = [ode](const At& at, VectorRef xdot) { ode(at, xdot); };
    leaf.declare_continuous_state(state);
    const auto y = [](const auto& at) {
      using std::sin;
      return sin(at.x(0)) + 2.0 * at.u(0, 0);
    };
    if (traced)
      leaf.declare_output_port({.name = "y", .formula = y});
    else
      leaf.declare_output_port(
          {.name = "y", .calc = [](const At& at) { return std::sin(at.x[0]) + 2.0 * at.u(0); }});
  });
}

/// u -> Saturate(-1, 1) -> x' = its output; the input is the parameter "u.value".
Diagram limited(double u) {
  DiagramBuilder builder;
  auto& source = builder.add<Constant>("u", u);
  auto& limiter =
      builder.add<Saturate>("limiter", SaturateOptions{.lower_limit = -1.0, .upper_limit = 1.0});
  auto& x = builder.add<Integrator>("x");
  builder.connect(source.output(), limiter.input());
  builder.connect(limiter.output(), x.input());
  builder.export_output(x.output(), "y");
  return builder.build();
}

std::string refusal(const System& system, const Context& context,
                    const LinearizeOptions& options = {}) {
  return message<ModelError>([&] { linearize(system, context, options); });
}

}  // namespace

TEST_CASE("a pendulum has its matrices by hand, exactly and by differences", "[linearize]") {
  for (const bool traced : {true, false}) {
    const Leaf leaf = pendulum(traced);
    const Linearization found =
        linearize(leaf, leaf.create_context(),
                  {.inputs = {{"u", 0.7}, "c"}, .outputs = {{{"y", leaf.output("y")}}}});
    Eigen::MatrixXd a(2, 2), b(2, 2), c(1, 2), d(1, 2);
    a << 0.0, 1.0, -9.81 * std::cos(0.5), -0.3;
    b << 0.0, 0.0, 1.0, -0.2;
    c << std::cos(0.5), 0.0;
    d << 2.0, 0.0;
    // exact: a few roundings of the terms; differences: 1e-10 of a derivative (see TangentProbe)
    const double error = traced ? 1e-14 : 1e-9;
    CHECK((found.A - a).cwiseAbs().maxCoeff() < 10.0 * error);
    CHECK((found.B - b).cwiseAbs().maxCoeff() < error);
    CHECK((found.C - c).cwiseAbs().maxCoeff() < error);
    CHECK((found.D - d).cwiseAbs().maxCoeff() < error);
    CHECK(found.differences.empty() == traced);
    CHECK(found.states == std::vector<std::string>{"angle", "omega"});
    CHECK(found.inputs == std::vector<std::string>{"u", "c"});
    CHECK_THAT(found.xdot[1], WithinRel(-9.81 * std::sin(0.5) - 0.06 + 0.7, 1e-14));
    CHECK_THAT(found.y[0], WithinRel(std::sin(0.5) + 1.4, 1e-15));
    CHECK(found.u == vec({0.7, 0.3}));
  }
}

TEST_CASE("Saturate is linearised by its present side", "[linearize]") {
  for (const double u : {0.5, 3.0}) {
    const Diagram system = limited(u);
    const Linearization found = linearize(system, system.create_context(), {.inputs = {"u.value"}});
    CHECK(found.B(0, 0) == (u < 1.0 ? 1.0 : 0.0));
    CHECK(found.C(0, 0) == 1.0);
    CHECK(found.D(0, 0) == 0.0);
    CHECK(!found.frozen.empty());
  }
}

TEST_CASE("Saturate at its limit has no linearisation, and one side of it has", "[linearize]") {
  const Diagram system = limited(1.0);
  const Context at = system.create_context();
  CHECK(contains(refusal(system, at, {.inputs = {"u.value"}}), "relation 'limiter."));
  CHECK_NOTHROW(linearize(system, at));  // the limit does not move
  const double b = linearize(system, at, {.inputs = {"u.value"}, .one_sided = true}).B(0, 0);
  CHECK((b == 0.0 || b == 1.0));
}

TEST_CASE("a guard with an effect at zero is refused, and clear of zero is not", "[linearize]") {
  const models::BouncingBall ball(9.81, 0.8);
  const auto context = ball.create_context();
  const Linearization flight = linearize(ball, context.with_continuous_state({1.0, 0.0}));
  CHECK(flight.A(0, 1) == 1.0);
  CHECK(flight.A.cwiseAbs().sum() == 1.0);
  const std::string at_floor = refusal(ball, context.with_continuous_state({0.0, -3.0}));
  CHECK(contains(at_floor, "t = 0 s"));
  CHECK(contains(at_floor, "guard 'ball.bounce' has an effect and is at zero"));
}

TEST_CASE("guards that can fire are named, with their values and directions", "[linearize]") {
  const models::BouncingBall ball;
  const Linearization found =
      linearize(ball, ball.create_context().with_continuous_state(vec({2.5, -1.0})));
  REQUIRE(found.guards.size() == 1);
  CHECK(found.guards[0].name == "ball.bounce");
  CHECK(found.guards[0].value == 2.5);
  CHECK(found.guards[0].direction == Direction::positive_then_non_positive);
}

TEST_CASE("a block at rest is refused", "[linearize]") {
  const models::BouncingBall ball(9.81, 0.5);
  const auto start = ball.create_context().with_continuous_state({1.0, 0.0});
  const Context at_rest = simulate(ball, start, {0.0, 10.0}).context;
  CHECK(contains(refusal(ball, at_rest), "is at rest"));
}

TEST_CASE("a kink of a formula is refused where both sides differ", "[linearize]") {
  const auto leaf_of = [](auto rate) {
    return Leaf("leaf", [rate](Leaf& leaf) {
      leaf.declare_continuous_state(
          {.initial = vec({0.0}),
           .ode = equations<1>([rate](const auto& at, auto& xdot) { xdot[0] = rate(at.x(0)); })});
    });
  };
  const Leaf kink = leaf_of([](const auto& x) {
    using std::abs;
    return abs(x);
  });
  CHECK(contains(refusal(kink, kink.create_context()), "kink"));
  CHECK(linearize(kink, kink.create_context().with_continuous_state({-2.0})).A(0, 0) == -1.0);
  const Leaf drag = leaf_of([](const auto& v) {
    using std::abs;
    return -v * abs(v);
  });
  CHECK(linearize(drag, drag.create_context()).A(0, 0) == 0.0);
  const Leaf root = leaf_of([](const auto& x) {
    using std::sqrt;
    return sqrt(x);
  });
  CHECK(contains(refusal(root, root.create_context()), "not finite"));
}

TEST_CASE("names that are wrong are refused", "[linearize]") {
  const Leaf leaf = pendulum(true);
  const Context at = leaf.create_context();
  CHECK(contains(refusal(leaf, at), "not connected"));
  CHECK(contains(refusal(leaf, at, {.inputs = {"u"}}), "is open and has no value"));
  CHECK(contains(refusal(leaf, at, {.inputs = {{"u", 0.0}, "d"}}), "did you mean 'c'"));
  CHECK(contains(refusal(leaf, at, {.inputs = {{"u", 0.0}, "angle"}}), "is a state"));
  CHECK(contains(refusal(leaf, at, {.inputs = {{"u", 0.0}, "c", "c"}}), "named twice"));
}

TEST_CASE("discrete states are constant, and named", "[linearize]") {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", IntegratorOptions{.initial_state = 1.0});
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.1);
  auto& gain = builder.add<Gain>("gain", -3.0);
  builder.connect(x.output(), hold.input());
  builder.connect(hold.output(), gain.input());
  builder.connect(gain.output(), x.input());
  const Diagram system = builder.build();
  const Linearization found = linearize(system, system.create_context());
  CHECK(found.A(0, 0) == 0.0);
  REQUIRE(found.frozen.size() == 1);
  CHECK(found.frozen[0].name == "hold.z[0]");
}

TEST_CASE("a loop has the poles of its characteristic polynomial", "[linearize]") {
  // x'' = -4 x - 2 x' has the poles -1 +- i sqrt(3)
  DiagramBuilder builder;
  auto& v = builder.add<Integrator>("v");
  auto& x = builder.add<Integrator>("x");
  auto& k = builder.add<Gain>("k", -4.0);
  auto& c = builder.add<Gain>("c", -2.0);
  auto& sum = builder.add<Adder>("sum");
  builder.connect(v.output(), x.input());
  builder.connect(x.output(), k.input());
  builder.connect(v.output(), c.input());
  builder.connect(k.output(), sum.input(0));
  builder.connect(c.output(), sum.input(1));
  builder.connect(sum.output(), v.input());
  const Diagram system = builder.build();
  const auto poles = linearize(system, system.create_context()).poles();
  REQUIRE(poles.size() == 2);
  for (const auto& pole : poles) {
    CHECK_THAT(pole.real(), WithinAbs(-1.0, 1e-14));
    CHECK_THAT(std::abs(pole.imag()), WithinAbs(std::sqrt(3.0), 1e-14));
  }
}
