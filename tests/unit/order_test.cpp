// Order: every output after what it reads; an algebraic loop is printed as the path it is.
#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("outputs are ordered after what they read, however blocks were added", "[order]") {
  DiagramBuilder builder;
  std::vector<Gain*> chain;
  for (int i = 0; i < 50; ++i) chain.push_back(&builder.add<Gain>(text("gain_", i), 1.0));
  auto& clock = builder.add<Clock>("clock");
  for (std::size_t i = 0; i + 1 < 50; ++i)
    builder.connect(chain[i + 1]->output(), chain[i]->input());
  builder.connect(clock.output(), chain[49]->input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  std::vector<std::size_t> place(plan->nodes.size());
  for (std::size_t i = 0; i < plan->order.size(); ++i)
    place[static_cast<std::size_t>(plan->order[i])] = i;
  CHECK(plan->order.size() == plan->nodes.size());
  for (std::size_t i = 0; i < plan->nodes.size(); ++i) {
    for (const int need : plan->nodes[i].needs)
      CHECK(place[static_cast<std::size_t>(need)] < place[i]);
  }
}

// Each wire is followed once: by rounds over all blocks this would take minutes, by recursion more
// stack than there is.
TEST_CASE("a hundred thousand blocks in a row are planned, the last one added first", "[order]") {
  constexpr std::size_t n = 100'000;
  DiagramBuilder builder;
  std::vector<Gain*> chain;
  for (std::size_t i = 0; i < n; ++i) chain.push_back(&builder.add<Gain>(text("gain_", i), 1.0));
  auto& start = builder.add<Constant>("start", vec({1.0, 2.0}));
  auto& end = builder.add<Integrator>("end", Integrator::Options{.initial_state = vec({0.0, 0.0})});
  for (std::size_t i = 0; i + 1 < n; ++i)
    builder.connect(chain[i + 1]->output(), chain[i]->input());
  builder.connect(start.output(), chain[n - 1]->input());
  builder.connect(chain[0]->output(), end.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  CHECK(plan->order.size() == plan->nodes.size());
  CHECK(plan->needs.constants.size() == n);  // the start is a parameter, shown as it is
  CHECK(plan->nodes.front().shape.size == 2);
}

TEST_CASE("an algebraic loop is printed as the path of ports, with the remedy", "[order]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& sum = builder.add<Adder>("sum");
  auto& gain = builder.add<Gain>("gain", 0.5);
  auto& offset = builder.add<Offset>("offset", 1.0);
  builder.connect(clock.output(), sum.input(0)), builder.connect(offset.output(), sum.input(1));
  builder.connect(sum.output(), gain.input()), builder.connect(gain.output(), offset.input());
  const std::string what = message<ModelError>([&] { builder.build(); });
  INFO(what);
  CHECK(contains(what, "algebraic loop"));
  CHECK(
      contains(what, "  'sum.out' reads\n  'offset.out' reads\n  'gain.out' reads\n  'sum.out'\n"));
  CHECK(!contains(what, "clock"));
  CHECK(contains(what, "Integrator, UnitDelay"));
}

TEST_CASE("a loop through nested diagrams is printed with the paths of its leaves", "[order]") {
  DiagramBuilder inside;
  auto& gain = inside.add<Gain>("gain", 0.5);
  inside.export_input(gain.input(), "u"), inside.export_output(gain.output(), "y");
  DiagramBuilder outside;
  auto box = std::make_shared<Diagram>(inside.build("box"));
  outside.add(box);
  auto& negate =
      outside.add<ReduceBlock>("negate", 1, [](std::span<const double> u) { return -u[0]; });
  outside.connect(box->output(), negate.input()), outside.connect(negate.output(), box->input());
  const std::string what = message<ModelError>([&] { outside.build(); });
  CHECK(contains(what, "'box.gain.out' reads"));
  CHECK(contains(what, "'negate.out' reads"));
}

TEST_CASE("an Integrator, a UnitDelay or an output that does not read its input breaks a loop",
          "[order]") {
  const auto compiles = [](auto add) {
    DiagramBuilder builder;
    auto& gain = builder.add<Gain>("gain", 0.5);
    LeafSystem& block = add(builder);
    builder.connect(gain.output(), block.input()), builder.connect(block.output(), gain.input());
    return message<ModelError>([&] { builder.build(); }) == "no exception";
  };
  CHECK(compiles([](DiagramBuilder& b) -> LeafSystem& { return b.add<Integrator>("block"); }));
  CHECK(compiles([](DiagramBuilder& b) -> LeafSystem& { return b.add<UnitDelay>("block", 1.0); }));
  CHECK(compiles(
      [](DiagramBuilder& b) -> LeafSystem& { return b.add<ZeroOrderHold>("block", 1.0); }));
  CHECK(compiles([](DiagramBuilder& b) -> LeafSystem& {
    return b.add<Leaf>("block", [](Leaf& l) {
      l.declare_input_port({.shape = Shape::scalar()});
      l.declare_output_port({.calc = [](const At& at) { return at.time; }, .reads = Reads::time});
    });
  }));
  CHECK(!compiles([](DiagramBuilder& b) -> LeafSystem& { return b.add<Offset>("block", 1.0); }));
}

TEST_CASE("a block that reads itself is the shortest loop", "[order]") {
  DiagramBuilder builder;
  auto& self = builder.add<ReduceBlock>("self", 1, [](std::span<const double> u) { return u[0]; });
  builder.connect(self.output(), self.input());
  CHECK(contains(message<ModelError>([&] { builder.build(); }),
                 "  'self.out' reads\n  'self.out'\n"));
}

TEST_CASE("a ring of blocks that take any width is called a loop, not a width that cannot be told",
          "[order]") {
  DiagramBuilder builder;
  auto& one = builder.add<Gain>("one", 0.5);
  auto& two = builder.add<Gain>("two", 0.5);
  builder.connect(one.output(), two.input()), builder.connect(two.output(), one.input());
  CHECK(contains(message<ModelError>([&] { builder.build(); }), "algebraic loop"));
}
