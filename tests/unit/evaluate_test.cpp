// Values at a context without a run, and inputs with a fixed value.
#include "saltus/simulation/evaluate.hpp"

#include "saltus/base/model_errors.hpp"
#include "saltus/library/library.hpp"
#include "saltus/models/bouncing_ball.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinRel;

namespace {

/// x' = -2 x + u, with the outputs x and 3 u.
Leaf relaxation(const std::string& name = "plant") {
  return Leaf(name, [](Leaf& leaf) {
    leaf.declare_continuous_state(
        {.initial = vec({4.0}), .ode = [](const At& at) { return -2.0 * at.x[0] + at.u(0); }});
    leaf.declare_input_port({.name = "u"});
    leaf.declare_continuous_state_output("x");
    leaf.declare_output_port(
        {.name = "thrice", .calc = [](const At& at) { return 3.0 * at.u(0); }});
  });
}

/// The ramp x' = 1, the comparison x < 2, and z' = switch(x < 2, 5, 7).
Diagram switched() {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& two = builder.add<Constant>("two", 2.0);
  auto& five = builder.add<Constant>("five", 5.0);
  auto& seven = builder.add<Constant>("seven", 7.0);
  auto& x = builder.add<Integrator>("x");
  auto& less = builder.add<Comparator>("less", "<");
  auto& choice = builder.add<Switch>("choice");
  auto& z = builder.add<Integrator>("z");
  builder.connect(one.output(), x.input());
  builder.connect(x.output(), less.input(0));
  builder.connect(two.output(), less.input(1));
  builder.connect(five.output(), choice.input("true_value"));
  builder.connect(less.output(), choice.input("control"));
  builder.connect(seven.output(), choice.input("false_value"));
  builder.connect(choice.output(), z.input());
  return builder.build();
}

}  // namespace

TEST_CASE("an open input may have a fixed value", "[evaluate]") {
  Leaf plant = relaxation();
  plant.fix_input(0, 6.0);
  const Context begin = plant.create_context();
  // x(t) = 3 + exp(-2 t)
  CHECK_THAT(simulate(plant, begin, {0.0, 1.0}).context.continuous_state()[0],
             WithinRel(3.0 + std::exp(-2.0), 1e-5));
  CHECK(evaluate_time_derivatives(plant, begin) == vec({-2.0}));
  CHECK(evaluate_output(plant, plant.output("thrice"), begin).values == vec({18.0}));
  CHECK(evaluate_input(plant, plant.input(), begin).values == vec({6.0}));
  plant.fix_input(0, 8.0);  // the last value counts
  CHECK(evaluate_time_derivatives(plant, begin) == vec({0.0}));
}

TEST_CASE("a fixed value has the width that it was given with", "[evaluate]") {
  Gain gain("gain", 2.0);
  gain.fix_input(0, vec({1.0, -3.0}));
  const SignalValue y = evaluate_output(gain, gain.output(), gain.create_context());
  CHECK(y.values == vec({2.0, -6.0}));
  CHECK(y.shape == Shape::of(2));
  gain.fix_input(0, 1.5);
  CHECK(evaluate_output(gain, gain.output(), gain.create_context()).shape == Shape::scalar());
}

TEST_CASE("a fixed input is no open one inside of diagrams", "[evaluate]") {
  DiagramBuilder inner;
  auto& open = inner.add<Gain>("open", 10.0);
  auto& fixed = inner.add<Gain>("fixed", 100.0);
  auto& sum = inner.add<Adder>("sum", "++");
  fixed.fix_input(0, 2.0);
  inner.connect(open.output(), sum.input(0));
  inner.connect(fixed.output(), sum.input(1));
  inner.export_input(open.input(), "u");
  inner.export_output(sum.output(), "y");
  const auto part = std::make_shared<Diagram>(inner.build("part"));
  part->fix_input(0, 5.0);  // the exported input
  CHECK(evaluate_output(*part, part->output(), part->create_context()).values == vec({250.0}));
  DiagramBuilder outer;
  outer.add(part);
  const Diagram whole = outer.build();
  CHECK(evaluate_output(whole, part->output(), whole.create_context()).values == vec({250.0}));
  CHECK(evaluate_input(whole, part->input(), whole.create_context()).values == vec({5.0}));
}

TEST_CASE("of two systems that fix one input the outer one counts", "[evaluate]") {
  DiagramBuilder builder;
  auto& gain = builder.add<Gain>("gain", 10.0);
  builder.export_input(gain.input(), "u");
  Diagram diagram = builder.build();
  gain.fix_input(0, 1.0);
  CHECK(evaluate_input(diagram, gain.input(), diagram.create_context()).values == vec({1.0}));
  diagram.fix_input(0, 2.0);
  CHECK(evaluate_input(diagram, gain.input(), diagram.create_context()).values == vec({2.0}));
}

TEST_CASE("an input has one source", "[evaluate]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& gain = builder.add<Gain>("gain", 2.0);
  auto& other = builder.add<Gain>("other", 2.0);
  gain.fix_input(0, 1.0);
  CHECK(message<BuilderError>([&] { builder.connect(clock.output(), gain.input()); }) ==
        "input 'in' of block 'gain' already has a source, its fixed value; an input takes one");
  builder.connect(clock.output(), other.input());
  other.fix_input(0, 1.0);
  CHECK(message<BuilderError>([&] { builder.build(); }) ==
        "input 'in' of block 'other' has two sources: a wire and its fixed value; an input takes "
        "one");
  other.free_input(0);
  const Diagram diagram = builder.build();
  compile(diagram);
  other.fix_input(0, 1.0);  // too late for `build`
  CHECK(message<BuilderError>([&] { compile(diagram); }) ==
        "input 'in' of block 'other' has two sources: output 'clock.out' and its fixed value; an "
        "input takes one");
}

TEST_CASE("a fixed value that is exported is the default of the diagram's input", "[evaluate]") {
  DiagramBuilder inner;
  auto& gain = inner.add<Gain>("gain", 10.0);
  inner.export_input(gain.input(), "u");
  inner.export_output(gain.output(), "y");
  const auto part = std::make_shared<Diagram>(inner.build("part"));
  gain.fix_input(0, 3.0);  // after the export
  DiagramBuilder outer;
  outer.add(part);
  const Diagram whole = outer.build();
  CHECK(evaluate_output(whole, part->output(), whole.create_context()).values == vec({30.0}));
  gain.free_input(0);
  CHECK(contains(message<InputNotConnectedError>([&] { compile(whole); }), "is not connected"));
}

TEST_CASE("a fixed value of another width than the input expects is refused", "[evaluate]") {
  Leaf leaf("leaf", [](Leaf& l) {
    l.declare_input_port({.name = "u", .shape = Shape::of(2)});
    l.declare_output_port({.name = "y", .calc = [](const At& at) { return at.u(0); }});
  });
  leaf.fix_input(0, vec({1.0, 2.0, 3.0}));
  CHECK(message<ShapeMismatchError>([&] { compile(leaf); }) ==
        "input 'u' of block 'leaf': expected shape (2,), found shape (3,) from its fixed value");
}

TEST_CASE("impossible fixed values are refused", "[evaluate]") {
  Gain gain("gain", 2.0);
  CHECK(contains(message<ModelError>([&] { gain.fix_input(1, 1.0); }), "has no input 1"));
  CHECK(contains(message<ModelError>([&] { gain.fix_input(0, Eigen::VectorXd()); }),
                 "the value of input 'in' of block 'gain': expected a number or a vector"));
  CHECK(contains(message<ModelError>([&] { gain.fix_input(0, std::nan("")); }),
                 "the value of input 'in' of block 'gain'"));
  CHECK(message<InputNotConnectedError>([&] { compile(gain); }) ==
        "input 'in' of block 'gain' is not connected; connect it to a block, for example a "
        "Constant");
}

TEST_CASE("a comparison has the truth of its guard at the context", "[evaluate]") {
  const Diagram diagram = switched();
  const auto rate_at = [&](double x) {
    const Context at = diagram.create_context().with_continuous_state({x, 0.0});
    return evaluate_time_derivatives(diagram, at, diagram["z"]);
  };
  CHECK(rate_at(1.0) == vec({5.0}));
  CHECK(rate_at(3.0) == vec({7.0}));
}

TEST_CASE("at the end of a run a comparison has the truth that the run held", "[evaluate]") {
  const Diagram diagram = switched();
  const Context end = simulate(diagram, diagram.create_context(), {0.0, 2.5}).context;
  CHECK(evaluate_time_derivatives(diagram, end) == vec({1.0, 7.0}));
}

TEST_CASE("a state at rest has the rate zero", "[evaluate]") {
  const saltus::Scene ball = models::bouncing_ball();
  const Context rest = simulate(*ball.system, ball.context, {0.0, 100.0}).context;
  CHECK(evaluate_time_derivatives(*ball.system, rest) == vec({0.0, 0.0}));
}

TEST_CASE("an evaluation changes nothing and no event happens", "[evaluate]") {
  int resets = 0;
  const Leaf leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "start",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = [&](const At&, Next&) { ++resets; }});
  });
  const Context begin = leaf.create_context();
  CHECK(evaluate_time_derivatives(leaf, begin) == vec({1.0}));
  CHECK(resets == 0);
}

TEST_CASE("a part outside of the system, and a context of another one, are refused", "[evaluate]") {
  const Diagram diagram = switched();
  const Gain other("other", 1.0);
  const Context begin = diagram.create_context();
  CHECK(message<ModelError>([&] { evaluate_time_derivatives(diagram, begin, other); }) ==
        "block 'other' is not part of system 'root'");
  CHECK(contains(message<ModelError>([&] { evaluate_output(diagram, other.output(), begin); }),
                 "which is not part of this system"));
  CHECK(contains(
      message<InputNotConnectedError>([&] { evaluate_input(diagram, other.input(), begin); }),
      "has no source in system 'root'"));
  CHECK(contains(
      message<ModelError>([&] { evaluate_time_derivatives(diagram, other.create_context()); }),
      "the context is not one of this system"));
}
