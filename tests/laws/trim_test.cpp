// trim and equilibria: operating points by closed forms, bounds, rank, guards, kinks, and refusals.
#include "saltus/analysis/trim.hpp"

#include <cmath>
#include <random>

#include "saltus/analysis/equilibria.hpp"
#include "saltus/library/library.hpp"
#include "saltus/model/equations.hpp"
#include "saltus/models/lorenz.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace trim_test {

constexpr double g = 9.81, pi = 3.141592653589793;
/// The search goes on to the rounding: a few roundings of values near 1, times a condition below 1e3.
constexpr double exact = 1e-12;

/// angle' = rate, rate' = torque - damping rate - g sin(angle).
Leaf pendulum(double angle = 0.4, double rate = 0.3) {
  return Leaf("pendulum", [=](Leaf& leaf) {
    leaf.declare_input_port({.name = "torque"});
    const ParameterIndex damping = leaf.declare_dynamic_parameter("damping", 0.6);
    ContinuousState state{.initial = vec({angle, rate}), .names = {"angle", "rate"}};
    state.ode = equations<2>([damping](const auto& at, auto& xdot) {
      using std::sin;
      xdot[0] = at.x(1);
      xdot[1] = at.u(0, 0) - at.p(damping, 0) * at.x(1) - g * sin(at.x(0));
    });
    leaf.declare_continuous_state(state);
  });
}

OperatingPoint trimmed(const System& system, const TrimOptions& options = {}) {
  return trim(system, system.create_context(), options);
}

/// h' = q - a sqrt(2 g h): the level of a tank with a hole, in units of its area.
Leaf tank(double q = 0.02, double a = 0.005) {
  return Leaf("tank", [=](Leaf& leaf) {
    const ParameterIndex inflow = leaf.declare_dynamic_parameter("q", q);
    const ParameterIndex hole = leaf.declare_dynamic_parameter("a", a);
    leaf.declare_continuous_state({.initial = vec({1.0}), .ode = [=](const At& at) {
                                     return at.p[inflow] -
                                            at.p[hole] * std::sqrt(2.0 * g * at.x[0]);
                                   }});
  });
}

/// y = 2 (u + bias), without a state.
Diagram chain() {
  DiagramBuilder builder;
  auto& sum = builder.add<Adder>("sum", "++");
  auto& bias = builder.add<Constant>("bias", 0.25);
  auto& gain = builder.add<Gain>("gain", 2.0);
  builder.connect(bias.output(), sum.input(1));
  builder.connect(sum.output(), gain.input());
  builder.export_input(sum.input(0), "u");
  builder.export_output(gain.output(), "y");
  return builder.build();
}

std::string refusal(const System& system, const TrimOptions& options) {
  return message<ModelError>([&] { trimmed(system, options); });
}

TEST_CASE("a pendulum hangs and stands", "[trim]") {
  struct Row {
    double start, angle;
    Stability stability;
  };
  for (const Row& row : {Row{0.4, 0.0, Stability::stable}, Row{2.8, pi, Stability::unstable}}) {
    const Leaf leaf = pendulum(row.start);
    const OperatingPoint point = trimmed(leaf, {.hold = {{"torque", 0.0}}});
    CHECK(point.status == SearchStatus::converged);
    CHECK(point.rank == 2);
    CHECK(point.notes.empty());
    CHECK_THAT(point.value("angle"), WithinAbs(row.angle, exact));
    CHECK_THAT(point.value("rate"), WithinAbs(0.0, exact));
    CHECK(point.stability() == row.stability);
    // the roots of s^2 + 0.6 s + g cos(angle)
    const std::complex<double> root =
        std::sqrt(std::complex<double>(0.09 - g * std::cos(row.angle)));
    CHECK(std::abs(point.poles()[0] - (-0.3 - root)) < 1e-11);
    CHECK(std::abs(point.poles()[1] - (-0.3 + root)) < 1e-11);
    CHECK_THAT(point.context.continuous_state()[0], WithinAbs(row.angle, exact));
  }
}

TEST_CASE("trim finds the torque that holds an angle, and a turn at a chosen rate", "[trim]") {
  const Leaf leaf = pendulum();
  const std::vector<FreeValue> free{{.name = "torque"}, {.name = "rate"}};
  const OperatingPoint held = trimmed(leaf, {.free = free, .hold = {{"angle", 1.0}}});
  CHECK_THAT(held.value("torque"), WithinRel(g * std::sin(1.0), exact));
  const Linearization again = linearize(leaf, held.context, {.inputs = held.inputs});
  CHECK(again.xdot.cwiseAbs().maxCoeff() < 1e-12);
  const OperatingPoint turn =
      trimmed(leaf, {.free = free, .hold = {{"angle", 0.5}}, .derivatives = {{"angle", 2.0}}});
  CHECK_THAT(turn.value("rate"), WithinRel(2.0, exact));
  CHECK_THAT(turn.value("torque"), WithinRel(1.2 + g * std::sin(0.5), exact));
  const OperatingPoint open = trimmed(leaf, {.free = {{{.name = "torque"}}},
                                             .hold = {{"angle", 0.5}, {"rate", 2.0}},
                                             .derivatives = {{"angle"}}});
  CHECK_THAT(open.value("torque"), WithinRel(turn.value("torque"), exact));
}

TEST_CASE("the level of a tank and its inverse, and steps that leave the domain", "[trim]") {
  const Leaf leaf = tank();
  CHECK_THAT(trimmed(leaf).value("x[0]"), WithinRel(16.0 / (2.0 * g), exact));  // Torricelli
  const OperatingPoint inflow = trimmed(
      leaf, {.free = {{{.name = "q", .lower = 0.0, .upper = 1.0}}}, .hold = {{"x[0]", 2.0}}});
  CHECK_THAT(inflow.value("q"), WithinRel(0.005 * std::sqrt(4.0 * g), exact));
  // a Newton step from h = 0.01 to a level of 5e-5 leads below 0, where the root is NaN
  const Leaf low = tank(1.6e-4);
  const OperatingPoint point = trimmed(low, {.free = {{{.name = "x[0]", .start = 0.01}}}});
  CHECK(point.success());
  CHECK_THAT(point.value("x[0]"), WithinRel(0.032 * 0.032 / (2.0 * g), 1e-9));
}

TEST_CASE("entries of a vector input, and what the equations do not separate", "[trim]") {
  const double mass = 1.3;
  const Leaf rotors("rotors", [mass](Leaf& leaf) {
    leaf.declare_input_port({.name = "thrust"});
    ContinuousState state{.initial = vec({5.0, 0.4}), .names = {"height", "speed"}};
    state.ode = [mass](const At& at, VectorRef xdot) {
      const VectorView thrust = at.u[0];
      xdot << at.x[1], (thrust[0] + thrust[1]) / mass - g;
    };
    leaf.declare_continuous_state(state);
  });
  const OperatingPoint hover =
      trimmed(rotors, {.free = {{{.name = "thrust[0]"}, {.name = "speed"}}},
                       .hold = {{"thrust", vec({0.0, 4.0})}}});
  CHECK_THAT(hover.value("thrust[0]"), WithinRel(mass * g - 4.0, 1e-11));
  CHECK(hover.undetermined.empty());
  const OperatingPoint both =
      trimmed(rotors, {.free = {{{.name = "thrust[0]"}, {.name = "thrust[1]"}, {.name = "speed"}}},
                       .hold = {{"thrust", vec({1.0, 1.0})}}});
  CHECK(both.rank == 2);
  CHECK(both.undetermined == std::vector<std::string>{"thrust[0]", "thrust[1]"});
  CHECK_THAT(both.inputs[0].value->sum(), WithinRel(mass * g, 1e-11));
  const OperatingPoint height = trimmed(rotors, {.hold = {{"thrust", vec({mass * g, 0.0})}}});
  CHECK(height.undetermined == std::vector<std::string>{"height"});
}

TEST_CASE("an output at a chosen value", "[trim]") {
  const Diagram system = chain();
  const OperatingPoint point =
      trimmed(system, {.free = {{{.name = "u"}}}, .outputs = {{"y", 3.0}}});
  CHECK_THAT(point.value("u"), WithinRel(1.25, exact));
  CHECK(point.stability() == Stability::no_states);
  const OperatingPoint bias = trimmed(
      system, {.free = {{{.name = "bias.value"}}}, .hold = {{"u", 1.0}}, .outputs = {{"y", 3.0}}});
  CHECK_THAT(bias.value("bias.value"), WithinRel(0.5, exact));
  // a block of the system by its port, whose name is free
  const OutputPort sum = system["sum"].output();
  const OperatingPoint inner =
      trimmed(system, {.free = {{{.name = "u"}}}, .outputs = {{"inner", sum, 4.0}}});
  CHECK_THAT(inner.value("u"), WithinRel(3.75, exact));
  CHECK(contains(
      refusal(system, {.free = {{{.name = "u"}}}, .outputs = {{"y", 3.0}, {"y", sum, 1.0}}}),
      "'y' names two outputs"));
}

TEST_CASE("what has no point says so, and a bound in the way is named", "[trim]") {
  const Leaf leaf = pendulum();
  const OperatingPoint none =
      trimmed(leaf, {.free = {{{.name = "angle"}}}, .hold = {{"torque", 10.0}, {"rate", 0.0}}});
  CHECK(none.status == SearchStatus::stalled);
  CHECK(contains(none.message, "'rate of rate' is"));
  CHECK(none.stability() == Stability::undecided);
  CHECK_THAT(none.residuals[1].value, WithinRel(10.0 - g, 1e-6));  // the least of |10 - g sin|
  const auto with_limit = [&](double upper) {
    return trimmed(leaf,
                   {.free = {{{.name = "torque", .lower = 0.0, .upper = upper}, {.name = "rate"}}},
                    .hold = {{"angle", 1.0}}});
  };
  const OperatingPoint bound = with_limit(5.0);
  CHECK(!bound.success());
  CHECK(bound.at_bounds == std::vector<std::string>{"torque"});
  CHECK(contains(bound.message, "with torque at a bound"));
  CHECK(with_limit(g * std::sin(1.0)).success());  // a solution on the bound
}

TEST_CASE("the unit does not decide convergence", "[trim]") {
  for (const double unit : {1e-12, 1e12}) {
    const auto line = [unit](auto rate) {
      return Leaf("line", [unit, rate](Leaf& leaf) {
        leaf.declare_continuous_state(
            {.initial = vec({3.0 * unit}), .ode = [rate](const At& at) { return rate(at.x[0]); }});
      });
    };
    const Leaf none = line([unit](double x) { return unit * (x * x / unit / unit + 1.0); });
    CHECK(!trimmed(none).success());
    const Leaf one = line([unit](double x) { return x / unit - 2.0; });
    const OperatingPoint point = trimmed(one);
    CHECK(point.success());
    CHECK_THAT(point.value("x[0]"), WithinRel(2.0 * unit, 1e-14));
  }
}

TEST_CASE("a guard on the way is named", "[trim]") {
  const Leaf heater("heater", [](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({20.0}), .ode = [](const At& at) { return 30.0 * at.mode - at.x[0]; }});
    leaf.declare_default_mode(1);
    leaf.declare_zero_crossing({.name = "hot",
                                .guard = [](const At& at) { return at.x[0] - 22.0; },
                                .direction = Direction::negative_then_non_negative,
                                .start_mode = 1,
                                .end_mode = 0});
  });
  const OperatingPoint point = trimmed(heater);
  CHECK_THAT(point.value("x[0]"), WithinRel(30.0, exact));
  CHECK(point.crossed == std::vector<std::string>{"heater.hot"});
  CHECK(contains(point.notes.at(0),
                 "'heater.hot' has an effect and lies between the start (g = -2)"));
  const Context heated = heater.create_context().with_continuous_state({29.0});
  CHECK(trim(heater, heated).crossed.empty());
}

TEST_CASE("a kink at the point is named", "[trim]") {
  DiagramBuilder builder;
  auto& limit =
      builder.add<Saturate>("limit", SaturateOptions{.lower_limit = -1.0, .upper_limit = 1.0});
  auto& plant = builder.add<Integrator>("plant", Integrator::Options{.initial_state = 0.3});
  builder.connect(limit.output(), plant.input());
  builder.export_input(limit.input(), "u");
  builder.export_output(limit.output(), "y");
  const Diagram system = builder.build();
  const std::vector<FreeValue> free{{.name = "u", .start = 0.5}};
  const OperatingPoint point = trimmed(system, {.free = free,
                                                .hold = {"plant.x[0]"},
                                                .derivatives = {{"plant.x[0]"}},
                                                .outputs = {{"y", 1.0}}});
  CHECK(point.success());
  CHECK(!point.smooth);
  REQUIRE(!point.notes.empty());
  CHECK(contains(point.notes.back(), "is at its root"));
  const OperatingPoint inside = trimmed(system, {.free = free, .hold = {"plant.x[0]"}});
  CHECK(inside.smooth);
  CHECK_THAT(inside.value("u"), WithinAbs(0.0, exact));
}

TEST_CASE("a double root has no rank, and the limit of evaluations is said", "[trim]") {
  const auto line = [](double start, auto rate) {
    return Leaf("line", [=](Leaf& leaf) {
      leaf.declare_continuous_state(
          {.initial = vec({start}), .ode = [rate](const At& at) { return rate(at.x[0]); }});
    });
  };
  const Leaf square = line(2.0, [](double x) { return (x - 1.0) * (x - 1.0); });
  const OperatingPoint point = trimmed(square);
  CHECK_THAT(point.value("x[0]"), WithinAbs(1.0, 1e-7));  // until the square is a rounding
  CHECK(point.undetermined == std::vector<std::string>{"x[0]"});
  CHECK(point.stability() == Stability::undecided);
  const Leaf hard = line(60.0, [](double x) { return std::exp(x) - 1e-3; });
  const OperatingPoint stopped = trimmed(hard, {.max_nfev = 2});
  CHECK(stopped.status == SearchStatus::max_nfev);
  CHECK(contains(stopped.message, "larger max_nfev"));
}

TEST_CASE("random flows of many sizes: a point that is found is a root", "[trim]") {
  for (unsigned seed = 0; seed < 30; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Index n = 1 + static_cast<Index>(random() % 8);
    const auto draw = [&] { return normal(random); };
    const Eigen::MatrixXd w = Eigen::MatrixXd::NullaryExpr(n, n, draw);
    const Eigen::VectorXd size = Eigen::VectorXd::NullaryExpr(
        n, [&] { return std::pow(10.0, static_cast<int>(random() % 13) - 6); });
    const auto flow = [w, size](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      const Eigen::VectorXd scaled = x.cwiseQuotient(size);
      return size.cwiseProduct(w * scaled.array().tanh().matrix() + 3.0 * scaled);
    };
    const Eigen::VectorXd root = Eigen::VectorXd::NullaryExpr(n, draw).cwiseProduct(size);
    const Eigen::VectorXd rest = flow(root);
    const Eigen::VectorXd start =
        root + 0.3 * Eigen::VectorXd::NullaryExpr(n, draw).cwiseProduct(size);
    const Leaf leaf("random", [&](Leaf& l) {
      l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                    xdot = flow(at.x) - rest;
                                  }});
    });
    const OperatingPoint point = trimmed(leaf);
    CHECK(point.success());
    // some hundred roundings of terms of size 10
    const Eigen::VectorXd off = flow(point.context.continuous_state()) - rest;
    CHECK(off.cwiseQuotient(size).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("equilibria finds the three points of a cubic, and those of a box only", "[trim]") {
  const Leaf cubic("cubic", [](Leaf& leaf) {
    leaf.declare_continuous_state({.initial = vec({0.5}), .ode = [](const At& at) {
                                     return at.x[0] - at.x[0] * at.x[0] * at.x[0];
                                   }});
  });
  const Equilibria found =
      equilibria(cubic, cubic.create_context(),
                 {.box = {{.name = "x[0]", .lower = -3.0, .upper = 2.0}}, .count = 16});
  REQUIRE(found.points.size() == 3);
  for (int i = 0; i < 3; ++i) {
    const OperatingPoint& point = found.points[static_cast<std::size_t>(i)];
    CHECK_THAT(point.value("x[0]"), WithinAbs(i - 1.0, 1e-12));
    CHECK_THAT(point.poles()[0].real(), WithinAbs(i == 1 ? 1.0 : -2.0, 1e-8));  // by differences
    CHECK(point.stability() == (i == 1 ? Stability::unstable : Stability::stable));
  }
  const Leaf leaf = pendulum();
  const Equilibria angles = equilibria(leaf, leaf.create_context(),
                                       {.box = {{.name = "angle", .lower = -4.0, .upper = 5.0},
                                                {.name = "rate", .lower = -1.0, .upper = 1.0}},
                                        .seed = 3,
                                        .hold = {{"torque", 0.0}}});
  REQUIRE(angles.points.size() == 3);
  CHECK(angles.starts == 32);
  for (int i = 0; i < 3; ++i)
    CHECK_THAT(angles.points[static_cast<std::size_t>(i)].value("angle"),
               WithinAbs((i - 1) * pi, 1e-9));
  const Equilibria listed =
      equilibria(leaf, leaf.create_context(),
                 {.starts = {{{"angle", 0.2}, {"rate", 0.0}}, {{"angle", 3.0}, {"rate", 0.0}}},
                  .hold = {{"torque", 0.0}}});
  CHECK(listed.points.size() == 2);
  const Equilibria none = equilibria(leaf, leaf.create_context(),
                                     {.box = {{.name = "angle", .lower = -4.0, .upper = 4.0}},
                                      .count = 4,
                                      .hold = {{"torque", 10.0}, {"rate", 0.0}}});
  CHECK(none.points.empty());
  CHECK(none.failures.size() == 4);
}

TEST_CASE("bad arguments of trim and equilibria are refused by name", "[trim]") {
  const Leaf leaf = pendulum();
  const LinearInput torque("torque", 0.0);
  CHECK(contains(refusal(leaf, {}), "input 'torque' of 'pendulum' is open and has no value"));
  CHECK(contains(refusal(leaf, {.free = {{{.name = "angel"}}}, .hold = {torque}}),
                 "did you mean 'angle'?"));
  CHECK(contains(refusal(leaf, {.free = {{{.name = "x"}}}, .hold = {torque}}), "has 2 entries"));
  CHECK(contains(refusal(leaf, {.free = {{{.name = "mode"}}}, .hold = {torque}}), "is a mode"));
  CHECK(contains(refusal(leaf, {.free = {{{.name = "angle"}, {.name = "x[0]"}}}, .hold = {torque}}),
                 "'angle' and 'x[0]' are one value"));
  CHECK(contains(refusal(leaf, {.free = {{{.name = "angle"}}}, .hold = {torque, {"x[0]", 1.0}}}),
                 "is free and held"));
  CHECK(contains(
      refusal(leaf, {.free = {{{.name = "angle", .lower = 2.0, .upper = 1.0}}}, .hold = {torque}}),
      "expected a lower bound below the upper bound"));
  CHECK(contains(
      refusal(leaf, {.free = {{{.name = "angle", .start = 3.0, .upper = 1.0}}}, .hold = {torque}}),
      "is outside of the bounds"));
  CHECK(contains(refusal(leaf, {.hold = {torque}, .derivatives = {{"damping"}}}),
                 "is no continuous state"));
  CHECK(contains(refusal(leaf, {.hold = {torque}, .outputs = {{"y", 1.0}}}), "'y'"));
  CHECK(contains(refusal(leaf, {.hold = {torque}, .tolerance = 2.0}), "between 0 and 1"));
  CHECK(contains(refusal(leaf, {.hold = {{"torque", not_a_number}}}), "expected finite numbers"));
  CHECK(contains(message<ModelError>([&] {
                   equilibria(leaf, leaf.create_context(),
                              {.box = {{.name = "angle", .lower = 0.0}}, .hold = {torque}});
                 }),
                 "expected finite bounds"));
  const Leaf root = tank(0.02, 0.005);
  CHECK(contains(refusal(root, {.free = {{{.name = "x[0]", .start = -1.0}}}}),
                 "at the start values"));
}

// The numbers of the Python module:
//   s = saltus.scene("lorenz"); p = saltus.trim(s.system, {f"x[{i}]": v for i, v in enumerate([8, 9, 27])})
//   print(list(p.values.values()), p.poles, p.margin)
TEST_CASE("trim has the values that the Python module has", "[trim]") {
  const Scene scene = models::lorenz();
  const OperatingPoint point = trim(*scene.system, scene.context,
                                    {.free = {{{.name = "x[0]", .start = 8.0},
                                               {.name = "x[1]", .start = 9.0},
                                               {.name = "x[2]", .start = 27.0}}}});
  CHECK(point.success());
  CHECK_THAT(point.value("x[0]"), WithinRel(8.48528137423857, exact));
  CHECK_THAT(point.value("x[1]"), WithinRel(8.48528137423857, exact));
  CHECK_THAT(point.value("x[2]"), WithinRel(27.0, exact));
  CHECK_THAT(point.poles()[0].real(), WithinRel(-13.854577914596042, 1e-11));
  CHECK_THAT(point.poles()[2].real(),
             WithinRel(0.09395562396468593, 1e-10));  // of terms of size 10
  CHECK_THAT(point.poles()[2].imag(), WithinRel(10.19450522092785, 1e-11));
  CHECK(point.stability() == Stability::unstable);
}

}  // namespace trim_test
