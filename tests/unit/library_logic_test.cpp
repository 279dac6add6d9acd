// Comparator, LogicalOperator, Switch: truth tables, what is located and held, and error texts.
#include "library_support.hpp"
#include "saltus/plan/compile.hpp"

using namespace saltus;
using namespace library_test;

namespace {

/// A block that depends on time behind a Sine, in front of an Integrator: it reaches a derivative.
template <class Block, class... Arguments>
std::shared_ptr<const Plan> in_front_of_integrator(DiagramBuilder& builder,
                                                   std::unique_ptr<Diagram>& diagram,
                                                   Arguments&&... arguments) {
  auto& sine = builder.add<Sine>("sine");
  auto& block = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
  auto& integrator = builder.add<Integrator>("integrator");
  for (int i = 0; i < static_cast<int>(block.input_names().size()); ++i)
    builder.connect(sine.output(), block.input(i));
  builder.connect(block.output(), integrator.input());
  diagram = std::make_unique<Diagram>(builder.build());
  return compile(*diagram);
}

template <class Block, class... Arguments>
std::string described(Arguments&&... arguments) {
  DiagramBuilder builder;
  std::unique_ptr<Diagram> diagram;
  return in_front_of_integrator<Block>(builder, diagram, std::forward<Arguments>(arguments)...)
      ->describe();
}

}  // namespace

TEST_CASE("Comparator compares entry by entry, also at equality", "[library]") {
  const std::vector<Value> inputs{Value{1.0, 2.0, 3.0}, 2.0};
  CHECK(Bench<Comparator>(inputs, "<").output() == Numbers{1.0, 0.0, 0.0});
  CHECK(Bench<Comparator>(inputs, "<=").output() == Numbers{1.0, 1.0, 0.0});
  CHECK(Bench<Comparator>(inputs, ">").output() == Numbers{0.0, 0.0, 1.0});
  CHECK(Bench<Comparator>(inputs, ">=").output() == Numbers{0.0, 1.0, 1.0});
  CHECK(Bench<Comparator>(inputs, "==").output() == Numbers{0.0, 1.0, 0.0});
  CHECK(Bench<Comparator>(inputs, "!=").output() == Numbers{1.0, 0.0, 1.0});
  CHECK(Bench<Comparator>(inputs, "<").node().boolean);
}

TEST_CASE("an unknown operator or function is refused with the nearest known one", "[library]") {
  CHECK(model_error([] { Comparator("below", "=<"); }) ==
        "block 'below': unknown operator '=<'; did you mean '<'? Known: '<', '<=', '>', '>=', "
        "'==', '!='");
  CHECK(model_error([] { LogicalOperator("gate", "nad"); }) ==
        "block 'gate': unknown function 'nad'; did you mean 'nand'? Known: 'or', 'and', 'not', "
        "'nor', 'nand', 'xor'");
  CHECK(contains(model_error([] { LogicalOperator("gate", "and", 0); }),
                 "expected 1 input or more, found 0"));
}

TEST_CASE("LogicalOperator has the truth tables of its names", "[library]") {
  const std::vector<Value> inputs{Value{0.0, 0.0, 1.0, 1.0}, Value{0.0, 1.0, 0.0, 1.0}};
  CHECK(Bench<LogicalOperator>(inputs, "or").output() == Numbers{0.0, 1.0, 1.0, 1.0});
  CHECK(Bench<LogicalOperator>(inputs, "and").output() == Numbers{0.0, 0.0, 0.0, 1.0});
  CHECK(Bench<LogicalOperator>(inputs, "nor").output() == Numbers{1.0, 0.0, 0.0, 0.0});
  CHECK(Bench<LogicalOperator>(inputs, "nand").output() == Numbers{1.0, 1.0, 1.0, 0.0});
  CHECK(Bench<LogicalOperator>(inputs, "xor").output() == Numbers{0.0, 1.0, 1.0, 0.0});
  CHECK(Bench<LogicalOperator>({Value{0.0, 1.0}}, "not").output() == Numbers{1.0, 0.0});
  CHECK(Bench<LogicalOperator>({1.0, 1.0, 1.0}, "xor", 3).output() == Numbers{1.0});
}

TEST_CASE("Switch takes a boolean, or a real control with a threshold that counts as reached",
          "[library]") {
  CHECK(Bench<Switch>({10.0, 1.0, 20.0}).output() == Numbers{10.0});
  CHECK(Bench<Switch>({10.0, 0.0, 20.0}).output() == Numbers{20.0});
  const Switch::Options half{.threshold = 0.5};
  CHECK(Bench<Switch>({10.0, 0.5, 20.0}, half).output() == Numbers{10.0});
  CHECK(Bench<Switch>({10.0, 0.4, 20.0}, half).output() == Numbers{20.0});
  CHECK(Bench<Switch>({Value{1.0, 2.0}, 0.0, 3.0}).output() == Numbers{3.0, 3.0});
}

TEST_CASE(
    "a relation that reaches a derivative is located and held, and the opaque ones are called so",
    "[library]") {
  CHECK(contains(described<Abs>(), "guard 'block.positive': a relation, held between instants"));
  CHECK(contains(described<Saturate>(Saturate::Options{.lower_limit = -0.5}),
                 "guard 'block.below': a relation"));
  CHECK(contains(described<Switch>(Switch::Options{.threshold = 0.5}),
                 "guard 'block.reached': a relation"));
  CHECK(contains(described<Comparator>("<"), "guard 'block.difference': a relation"));
  CHECK(contains(described<Comparator>("<"), "computed at instants: 2 (sine.out, block.out)"));
  CHECK(contains(described<Comparator>("=="), "'block' is an opaque boolean"));
}

TEST_CASE("a relation that reaches no derivative, guard or reset is not located", "[library]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& abs = builder.add<Abs>("abs");
  builder.connect(sine.output(), abs.input());
  const Diagram diagram = builder.build();
  CHECK(
      contains(compile(diagram, {{"y", abs.output()}})->describe(), "no guards: no root-finding"));
}
