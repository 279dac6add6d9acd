// Integrator: its ports, derivative and reset map as the plan and the machine see them, and error
// texts.
#include "library_support.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/machine.hpp"

using namespace saltus;
using namespace library_test;

namespace {

using Names = std::vector<std::string>;

/// xdot of an Integrator between constants, its relations set by hand: {at_lower, at_upper,
/// rising}.
double rate_of(const Integrator::Options& options, const std::vector<Value>& inputs,
               const std::vector<double>& truths = {}) {
  DiagramBuilder builder;
  auto& block = builder.add<Integrator>("block", options);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    builder.connect(builder.add<Constant>(text("u", i), inputs[i]).output(),
                    block.input(static_cast<int>(i)));
  }
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  Machine machine(plan);
  machine.load(diagram.create_context());
  for (std::size_t r = 0; r < truths.size(); ++r)
    *machine.signal(plan->leaves[0].relations[r]) = truths[r];
  double xdot = 0.0;
  machine.derivative(0.0, machine.x.data(), &xdot);
  return xdot;
}

}  // namespace

TEST_CASE("the ports of an Integrator stand in a fixed order, each only if enabled", "[library]") {
  CHECK(Integrator("i").input_names() == Names{"in"});
  CHECK(Integrator("i", {.enable_reset = true}).input_names() == Names{"in", "reset_trigger"});
  CHECK(Integrator("i", {.enable_reset = true, .enable_external_reset = true, .enable_hold = true})
            .input_names() == Names{"in", "reset_trigger", "reset_value", "hold_trigger"});
  CHECK(Integrator("i", {.enable_hold = true}).input_names() == Names{"in", "hold_trigger"});
}

TEST_CASE("the output of an Integrator is a view of its state in the shape of initial_state",
          "[library]") {
  Bench<Integrator> scalar({1.0}, Integrator::Options{.initial_state = 4.0});
  Bench<Integrator> vector({Value{1.0, 2.0}}, Integrator::Options{.initial_state = {4.0, 5.0}});
  CHECK(scalar.output() == Numbers{4.0});
  CHECK(scalar.node().shape == Shape::scalar());
  CHECK(scalar.node().view);
  CHECK(vector.output() == Numbers{4.0, 5.0});
  CHECK(vector.node().shape == Shape::of(2));
}

TEST_CASE("xdot = u, and 0 while hold_trigger is true", "[library]") {
  CHECK(rate_of({}, {3.0}) == 3.0);
  CHECK(rate_of({.enable_hold = true}, {3.0, 0.0}) == 3.0);
  CHECK(rate_of({.enable_hold = true}, {3.0, 1.0}) == 0.0);
}

TEST_CASE("an Integrator stands still only at a limit and pushed outward", "[library]") {
  const Integrator::Options limits{.enable_limits = true, .lower_limit = -1.0, .upper_limit = 1.0};
  CHECK(rate_of(limits, {3.0}, {0.0, 0.0, 1.0}) == 3.0);
  CHECK(rate_of(limits, {3.0}, {0.0, 1.0, 1.0}) == 0.0);
  CHECK(rate_of(limits, {-3.0}, {0.0, 1.0, 0.0}) == -3.0);
  CHECK(rate_of(limits, {-3.0}, {1.0, 0.0, 0.0}) == 0.0);
  CHECK(rate_of(limits, {3.0}, {1.0, 0.0, 1.0}) == 3.0);
}

TEST_CASE("chains of constants in front of an Integrator are computed once", "[library]") {
  DiagramBuilder builder;
  auto& constant = builder.add<Constant>("constant", 2.0);
  auto& gain = builder.add<Gain>("gain", 3.0);
  auto& sum = builder.add<Adder>("sum", "++");
  auto& integrator = builder.add<Integrator>("integrator");
  builder.connect(constant.output(), gain.input());
  builder.connect(gain.output(), sum.input(0));
  builder.connect(constant.output(), sum.input(1));
  builder.connect(sum.output(), integrator.input());
  const Diagram diagram = builder.build();
  const std::string plan = compile(diagram)->describe();
  CHECK(contains(plan, "constant, computed once: 2 (gain.out, sum.out)"));
  CHECK(contains(plan, "computed for the derivatives: 0"));
  CHECK(contains(plan, "no guards: no root-finding"));
}

TEST_CASE("an Integrator in a loop is no algebraic loop", "[library]") {
  DiagramBuilder builder;
  auto& integrator =
      builder.add<Integrator>("integrator", Integrator::Options{.initial_state = 1.0});
  auto& gain = builder.add<Gain>("gain", -1.0);
  builder.connect(integrator.output(), gain.input());
  builder.connect(gain.output(), integrator.input());
  const Diagram diagram = builder.build();
  CHECK(contains(compile(diagram)->describe(), "computed for the derivatives: 1 (gain.out)"));
}

TEST_CASE("options of an Integrator that contradict each other are refused", "[library]") {
  CHECK(model_error([] { Integrator("i", {.enable_external_reset = true}); }) ==
        "block 'i': enable_external_reset without enable_reset; a value to reset to needs a "
        "trigger: set both");
  CHECK(contains(model_error([] { Integrator("i", {.enable_limits = true}); }),
                 "enable_limits without a limit"));
  CHECK(contains(model_error([] {
                   Integrator("i", {.enable_limits = true, .lower_limit = 1.0, .upper_limit = 0.0});
                 }),
                 "lower_limit 1 is above upper_limit 0"));
  CHECK(contains(model_error([] { Integrator("i", {.zeno_tolerance = -1.0}); }),
                 "expected a time >= 0 s"));
  CHECK(contains(
      model_error([] { Integrator("i", {.enable_limits = true, .upper_limit = Value{1.0, 2.0}}); }),
      "a limit has 2 values, initial_state has 1"));
  CHECK(model_error([] { Bench<Integrator>({Value{1.0, 2.0}}); }) ==
        "input 'in' of block 'block': expected a scalar, found shape (2,) from output 'u0.out'");
}
