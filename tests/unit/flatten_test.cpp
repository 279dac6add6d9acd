// Flattening: nested diagrams to leaves with paths and wires; shapes along the wires.
#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// y = k u, `depth` diagrams deep.
std::shared_ptr<const System> nested_gain(double k, int depth) {
  std::shared_ptr<const System> inner = std::make_shared<Gain>("gain", k);
  for (int level = 0; level < depth; ++level) {
    DiagramBuilder builder;
    builder.add(inner);
    builder.export_input(inner->input(), "u"), builder.export_output(inner->output(), "y");
    inner = std::make_shared<Diagram>(builder.build(text("level_", level)));
  }
  return inner;
}

}  // namespace

TEST_CASE("a gain three diagrams deep is one leaf with a path, and does what it does",
          "[flatten]") {
  const int depth = GENERATE(0, 1, 2, 3);
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& integrator = builder.add<Integrator>("integrator");
  const auto gain = nested_gain(3.0, depth);
  builder.add(gain);
  builder.connect(clock.output(), gain->input()),
      builder.connect(gain->output(), integrator.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram, {{"y", gain->output()}});
  REQUIRE(plan->leaves.size() == 3);
  const std::string prefix[] = {"", "level_0.", "level_1.level_0.", "level_2.level_1.level_0."};
  CHECK(plan->leaves[2].path == prefix[depth] + "gain");
  CHECK(plan->needs.derivatives.size() == 2);
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0},
                                {.recorded_signals = {{"y", gain->output()}}});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(6.0, 1e-9));
  CHECK(column(results, "y").back() == 6.0);
}

TEST_CASE("an output exported twice, and a chain of exports, lead to the same leaf", "[flatten]") {
  DiagramBuilder inside;
  auto& clock = inside.add<Clock>("clock");
  inside.export_output(clock.output(), "a"), inside.export_output(clock.output(), "b");
  const auto inner = std::make_shared<Diagram>(inside.build("inner"));
  CHECK(inner->output("a").system == inner.get());
  CHECK(inner->output_source(0).leaf == &clock);
  CHECK(inner->output_source(1).leaf == &clock);
}

TEST_CASE("shapes spread along the wires, through blocks that take any", "[flatten]") {
  DiagramBuilder builder;
  auto& vector = builder.add<Constant>("vector", Value{1.0, 2.0, 3.0});
  auto& scalar = builder.add<Constant>("scalar", 2.0);
  auto& product = builder.add<Product>("product");
  auto& gain = builder.add<Gain>("gain", 2.0);
  builder.connect(scalar.output(), product.input(0)),
      builder.connect(vector.output(), product.input(1));
  builder.connect(product.output(), gain.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram, {{"y", gain.output()}, {"s", scalar.output()}});
  CHECK(plan->node(plan->taps[0].node).shape == Shape::of(3));
  CHECK(plan->node(plan->taps[1].node).shape == Shape::scalar());
}

TEST_CASE("a width that does not fit is refused with both ports", "[flatten]") {
  DiagramBuilder builder;
  auto& vector = builder.add<Constant>("vector", Value{1.0, 2.0, 3.0});
  auto& integrator =
      builder.add<Integrator>("integrator", Integrator::Options{.initial_state = {0.0, 0.0}});
  builder.connect(vector.output(), integrator.input());
  CHECK(message<ModelError>([&] { builder.build(); }) ==
        "input 'in' of block 'integrator': expected shape (2,), found shape (3,) from output "
        "'vector.out'");
}

TEST_CASE("vectors of different widths that meet are refused", "[flatten]") {
  DiagramBuilder builder;
  auto& two = builder.add<Constant>("two", Value{1.0, 2.0});
  auto& three = builder.add<Constant>("three", Value{1.0, 2.0, 3.0});
  auto& sum = builder.add<Adder>("sum");
  builder.connect(two.output(), sum.input(0)), builder.connect(three.output(), sum.input(1));
  CHECK(contains(message<ModelError>([&] { builder.build(); }),
                 "block 'sum': expected scalars and signals of one shape, found the shapes (2,), "
                 "(3,); bring"));
}

TEST_CASE("a width that depends on itself around a loop is refused with the remedy", "[flatten]") {
  DiagramBuilder builder;
  auto& a = builder.add<Gain>("a", 1.0);
  auto& b = builder.add<Gain>("b", 1.0);
  builder.connect(a.output(), b.input()), builder.connect(b.output(), a.input());
  const std::string what = message<ModelError>([&] { builder.build(); });
  CHECK((contains(what, "depends on itself around a loop") || contains(what, "algebraic loop")));
}

TEST_CASE("a declaration that reads an input there is none of is refused", "[flatten]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_output_port(
        {.name = "y", .calc = [](const At& at) { return at.u(1); }, .inputs = std::vector{1}});
  });
  CHECK(contains(message<ModelError>([&] { compile(leaf); }),
                 "block 'leaf': a declaration reads input 1, the block has 0"));
}
