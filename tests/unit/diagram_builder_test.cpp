// DiagramBuilder: what it refuses, the names it gives, and that blocks stay where they are.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("two blocks of one name, and one block twice, are refused", "[diagram_builder]") {
  DiagramBuilder builder;
  builder.add<Gain>("gain", 2.0);
  CHECK(message<ModelError>([&] { builder.add<Gain>("gain", 3.0); }) ==
        "two blocks are called 'gain'; give each block of a diagram its own name");
  const auto shared = std::make_shared<Clock>("clock");
  builder.add(shared);
  CHECK(message<ModelError>([&] { builder.add(shared); }) == "block 'clock' is added twice");
}

TEST_CASE("a block that was not added, and an input with two sources, are refused",
          "[diagram_builder]") {
  DiagramBuilder builder;
  const Clock foreign("foreign");
  auto& clock = builder.add<Clock>("clock");
  auto& gain = builder.add<Gain>("gain", 2.0);
  CHECK(message<ModelError>([&] { builder.connect(foreign.output(), gain.input()); }) ==
        "block 'foreign' was not added to this diagram; its blocks: 'clock', 'gain'");
  builder.connect(clock.output(), gain.input());
  CHECK(message<ModelError>([&] { builder.connect(clock.output(), gain.input()); }) ==
        "input 'in' of block 'gain' already has a source, block 'clock'; an input takes one");
  CHECK(contains(message<ModelError>([&] { builder.export_input(gain.input()); }),
                 "already has a source, block 'clock'"));
}

TEST_CASE("an open input, and a diagram without blocks, are refused when it is built",
          "[diagram_builder]") {
  DiagramBuilder empty;
  CHECK(message<ModelError>([&] { empty.build(); }) ==
        "build: the diagram has no block; add one first");
  DiagramBuilder builder;
  builder.add<Adder>("sum", "+-");
  CHECK(message<ModelError>([&] { builder.build(); }) ==
        "input 'in_0' of block 'sum' is not connected; connect it or export it");
}

TEST_CASE("a builder that was refused can be mended; one that built is spent",
          "[diagram_builder]") {
  DiagramBuilder builder;
  auto& gain = builder.add<Gain>("gain", 2.0);
  CHECK_THROWS_AS(builder.build(), ModelError);
  auto& clock = builder.add<Clock>("clock");
  builder.connect(clock.output(), gain.input());
  const Diagram diagram = builder.build("done");
  CHECK(diagram.name() == "done");
  CHECK(&diagram["gain"] == &gain);
  const std::string spent = "this DiagramBuilder was spent by build(); make a new one";
  CHECK(message<ModelError>([&] { builder.add<Clock>("more"); }) == spent);
  CHECK(message<ModelError>([&] { builder.connect(clock.output(), gain.input()); }) == spent);
  CHECK(message<ModelError>([&] { builder.build(); }) == spent);
}

TEST_CASE("exported ports have names, their own or the block's, and none twice",
          "[diagram_builder]") {
  DiagramBuilder builder;
  auto& gain = builder.add<Gain>("gain", 2.0);
  auto& other = builder.add<Gain>("other", 3.0);
  CHECK(builder.export_input(gain.input()) == 0);
  CHECK(builder.export_input(other.input(), "force") == 1);
  CHECK(builder.export_output(gain.output()) == 0);
  CHECK(builder.export_output(gain.output(), "same again") == 1);
  CHECK(contains(message<ModelError>([&] { builder.export_output(other.output(), "same again"); }),
                 "'same again' is declared twice"));
  CHECK(contains(message<ModelError>([&] { builder.connect(gain.output(), other.input()); }),
                 "the exported input 'force'"));
  const Diagram diagram = builder.build();
  CHECK(diagram.input_names() == std::vector<std::string>{"gain_in", "force"});
  CHECK(diagram.output_names() == std::vector<std::string>{"gain_out", "same again"});
  CHECK(message<ModelError>([&] { diagram["gaim"]; }) ==
        "diagram 'root' has no block 'gaim'; did you mean 'gain'? Known: 'gain', 'other'");
}

TEST_CASE("blocks without a name get one", "[diagram_builder]") {
  DiagramBuilder builder;
  builder.add<Clock>(""), builder.add<Clock>("");
  const Diagram diagram = builder.build();
  CHECK(diagram.children().size() == 2);
  CHECK(diagram.children()[0].name != diagram.children()[1].name);
  CHECK(diagram.children()[0].name.starts_with("block_"));
}

TEST_CASE("a diagram runs where it was moved to", "[diagram_builder]") {
  auto holder = std::make_unique<Diagram>([] {
    DiagramBuilder builder;
    auto& clock = builder.add<Clock>("clock");
    auto& integrator = builder.add<Integrator>("integrator");
    builder.connect(clock.output(), integrator.input());
    return builder.build();
  }());
  const Diagram diagram = std::move(*holder);
  holder.reset();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0});
  CHECK(std::abs(results.context.continuous_state()[0] - 2.0) < 1e-9);
}
