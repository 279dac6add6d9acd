// Pictures: which blocks and wires there are, and what becomes of them in a plan.
#include "saltus/plan/picture.hpp"

#include <algorithm>

#include "saltus/library/library.hpp"
#include "support/cells.hpp"

using namespace saltus;

namespace {

using Flow = Picture::Flow;

const Picture::Block& block(const Picture& drawn, std::string_view name) {
  return *std::ranges::find(drawn.blocks, name, &Picture::Block::name);
}

/// x' = 2 x, a step that resets x, and a gain nobody reads.
Diagram reset_by_a_step() {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", IntegratorOptions{.enable_reset = true});
  auto& gain = builder.add<Gain>("gain", 2.0);
  auto& floor = builder.add<Constant>("floor", 0.0);
  auto& below = builder.add<Comparator>("below", "<");
  auto& unread = builder.add<Gain>("unread", 1.0);
  builder.connect(x.output(), gain.input()), builder.connect(gain.output(), x.input("in"));
  builder.connect(x.output(), below.input(0)), builder.connect(floor.output(), below.input(1));
  builder.connect(below.output(), x.input("reset_trigger"));
  builder.connect(x.output(), unread.input());
  return builder.build("whole");
}

}  // namespace

TEST_CASE("a picture tells what is continuous, held, folded and dropped", "[picture]") {
  const Diagram diagram = reset_by_a_step();
  const Picture drawn = picture(diagram);
  CHECK(drawn.trouble.empty());
  CHECK(block(drawn, "x").flow == Flow::continuous);
  CHECK(block(drawn, "gain").flow == Flow::continuous);
  CHECK(block(drawn, "below").flow == Flow::held);
  CHECK(block(drawn, "floor").flow == Flow::folded);
  CHECK(block(drawn, "unread").flow == Flow::dropped);
}

TEST_CASE("only a wire that events alone read is an event wire", "[picture]") {
  const Diagram diagram = reset_by_a_step();
  const Picture drawn = picture(diagram);
  REQUIRE(drawn.wires.size() == 6);
  for (const auto& wire : drawn.wires) {
    const bool trigger = drawn.blocks[static_cast<std::size_t>(wire.from)].name == "below";
    CHECK(wire.event == trigger);
  }
}

TEST_CASE("the kind of a block is its class, without namespace and template arguments",
          "[picture]") {
  class Local final : public LeafSystem {};
  CHECK(Local().kind() == "Local");
  CHECK(Gain("g", 1.0).kind() == "Gain");
}

TEST_CASE("a system that does not compile is drawn, with the reason", "[picture]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& sum = builder.add<Integrator>("sum", Integrator::Options{.enable_reset = true});
  builder.connect(sine.output(), sum.input(0)), builder.connect(sine.output(), sum.input(1));
  const Diagram diagram = builder.build();
  const Picture drawn = picture(diagram);
  CHECK(drawn.wires.size() == 2);
  CHECK(drawn.trouble.find("put a Comparator between them") != std::string::npos);
  CHECK(block(drawn, "sum").flow == Flow::unknown);
}

TEST_CASE("names cannot break out of a label", "[picture]") {
  DiagramBuilder builder;
  builder.add<Constant>("a\"<b>\n`#;", 1.0);
  const Diagram diagram = builder.build("\"]; evil");
  CHECK(to_dot(diagram).find("a&quot;&lt;b&gt;<BR/>`#;") != std::string::npos);
  CHECK(to_dot(diagram).starts_with("digraph \"\\\"]; evil\" {"));
  CHECK(to_mermaid(diagram).find("a#34;#60;b#62;<br/>#96;#35;#59;") != std::string::npos);
}

namespace {

using Control = Picture::Control;

/// A signal that executes an integrator within an inner diagram.
Diagram executed(const Execution& execution) {
  DiagramBuilder inner;
  const auto& x = inner.add<Integrator>("x");
  inner.connect(inner.add<Constant>("one", 1.0).output(), x.input());
  inner.export_output(x.output(), "x");
  DiagramBuilder builder;
  const auto part = std::make_shared<Diagram>(inner.build("part"));
  builder.add(part);
  const auto& pulse = builder.add<Pulse>("pulse", PulseOptions{.period = 2.0});
  builder.execute(*part, pulse.output(), execution);
  return builder.build("whole");
}

}  // namespace

TEST_CASE("a control signal leads to the part that it executes", "[picture]") {
  const Diagram diagram = executed({});
  const Control inside = picture(diagram).controls.at(0);
  CHECK(inside.frame == 0);
  CHECK(inside.block == -1);
  CHECK(inside.words == "enables");
  CHECK(inside.flow == Flow::held);

  const Picture shallow = picture(diagram, {.max_depth = 1});
  const Control folded = shallow.controls.at(0);
  CHECK(folded.frame == -1);
  CHECK(nth(shallow.blocks, folded.block).name == "part");
  CHECK(nth(shallow.blocks, folded.from).name == "pulse");
}

TEST_CASE("a control signal says how it executes", "[picture]") {
  using enum Execution::Kind;
  const auto words = [](const Execution& execution) {
    return picture(executed(execution)).controls.at(0).words;
  };
  CHECK(words({.resets = true}) == "enables, resets");
  CHECK(words({.kind = triggered}) == "triggers ↑");
  CHECK(words({.kind = triggered, .edge = Edge::falling}) == "triggers ↓");
  CHECK(words({.kind = triggered, .edge = Edge::either}) == "triggers ↕");
}

TEST_CASE("an update with an inherited sample time runs at each trigger", "[picture]") {
  DiagramBuilder builder;
  const auto& delay = builder.add<UnitDelay>("z", inherited_period);
  const auto& pulse = builder.add<Pulse>("pulse");
  builder.connect(pulse.output(), delay.input());
  builder.execute(delay, pulse.output(), {.kind = Execution::Kind::triggered});
  const Picture drawn = picture(builder.build());
  const auto z = std::ranges::find(drawn.blocks, "z", &Picture::Block::name);
  REQUIRE(z != drawn.blocks.end());
  CHECK(std::ranges::count(z->notes, "tick at each trigger") == 1);
}

TEST_CASE("the edge of a control signal ends at the frame in each language", "[picture]") {
  const Diagram diagram = executed({});
  CHECK(to_dot(diagram).find("label=\"enables\" lhead=cluster_0];") != std::string::npos);
  CHECK(to_mermaid(diagram).find("-.->|\"enables\"| f0\n") != std::string::npos);
  const std::string style = text("linkStyle ", picture(diagram).wires.size(), " stroke:#D55E00");
  CHECK(to_mermaid(diagram).find(style) != std::string::npos);
  CHECK(to_dot(diagram, {.max_depth = 1}).find("label=\"enables\"];") != std::string::npos);
}

TEST_CASE("a diagram that nothing executes has no control signals", "[picture]") {
  CHECK(picture(reset_by_a_step()).controls.empty());
}

TEST_CASE("event wires are edges with the names of their events and inputs", "[picture]") {
  support::Network inner;
  inner.add(support::cell("cell", 2.0));
  inner.builder.export_event_output(inner.blocks.at("cell")->event_output("fire"), "spike");
  const auto group = std::make_shared<Diagram>(inner.builder.build("group"));
  support::Network net;
  net.builder.add(group);
  net.add(support::digits("digits"));
  for (const double weight : {1.0, 2.0})
    net.builder.connect_event(group->event_output("spike"),
                              net.blocks.at("digits")->event_input("digit"), weight);
  const Diagram diagram = net.builder.build();
  for (const int depth : {1, 9}) {
    const Picture drawn = picture(diagram, {.max_depth = depth});
    REQUIRE(drawn.event_wires.size() == 1);
    const Picture::EventWire& wire = drawn.event_wires.front();
    CHECK(nth(drawn.blocks, wire.from).name == (depth == 1 ? "group" : "cell"));
    CHECK(nth(drawn.blocks, wire.to).name == "digits");
    CHECK(event_label(wire) == "fire → digit (2)");
  }
  CHECK(support::contains(to_dot(diagram), "label=\"fire → digit (2)\"];"));
  CHECK(support::contains(to_dot(diagram), "event wire"));
  CHECK(support::contains(to_mermaid(diagram), "==>|\"fire → digit"));
}
