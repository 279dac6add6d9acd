// Event wires in a plan: sorted by source and delay, joined to islands, described.
#include "saltus/plan/compile.hpp"
#include "saltus/plan/detail/event_wiring.hpp"
#include "saltus/plan/islands.hpp"
#include "support/cells.hpp"

namespace event_wires_plan_test {

using namespace saltus;
using namespace support;

namespace {

/// The numbers of the wires of each batch of a source.
std::vector<std::vector<int>> batches_of(const Plan& plan, int source) {
  std::vector<std::vector<int>> all;
  const EventWires& wires = plan.event_wires;
  for (int b = wires.first_batch[source]; b < wires.first_batch[source + 1]; ++b) {
    all.emplace_back();
    for (int t = wires.batches[b].first; t < wires.batches[b].last; ++t)
      all.back().push_back(wires.targets[t].number);
  }
  return all;
}

}  // namespace

TEST_CASE("wires of a source and a delay are a batch, in the order of declaration",
          "[event_wires]") {
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 0.0)), net.add(beats("beats", {1.0}));
  net.wire("beats", "beat", "b", "synapse"), net.wire("a", "fire", "b", "synapse", 1.0, 0.5);
  net.wire("a", "fire", "a", "synapse", 2.0), net.wire("a", "fire", "b", "synapse", 3.0, 0.5);
  net.wire("a", "fire", "b", "synapse", 4.0);
  const Diagram diagram = net.builder.build();
  const auto plan = compile(diagram);
  CHECK(detail::event_source_of(*plan, 0, 0, 0) == 0);
  CHECK(detail::event_source_of(*plan, 1, 0, 0) == 1);
  CHECK(detail::event_source_of(*plan, 2, 0, 0) == 2);  // a time event, after the guards
  CHECK(detail::event_source_of(*plan, 0, 1, 0) == -1);
  CHECK(detail::event_source_of(*plan, 0, 0, 1) == -1);
  for (const int source : {0, 1, 2}) {
    const detail::EventOrigin from = detail::event_origin_of(*plan, source);
    CHECK(detail::event_source_of(*plan, from.leaf, from.event, from.entry) == source);
  }
  CHECK(batches_of(*plan, 0) == std::vector<std::vector<int>>{{2, 4}, {1, 3}});
  CHECK(batches_of(*plan, 1).empty());
  CHECK(batches_of(*plan, 2) == std::vector<std::vector<int>>{{0}});
  CHECK(contains(plan->describe(), "event wires: 5, in 3 batches of one event and one delay"));
  CHECK(contains(plan->describe(), "event wires start from it"));
}

TEST_CASE("an event wire joins its blocks to one island", "[event_wires]") {
  const auto islands = [](bool wired) {
    Network net;
    net.add(cell("a", 2.0)), net.add(cell("b", 0.0)), net.add(cell("c", 2.0));
    net.add(beats("beats", {1.0}));
    if (wired) net.wire("a", "fire", "b", "synapse"), net.wire("beats", "beat", "c", "synapse");
    const Diagram diagram = net.builder.build();
    return find_islands(*compile(diagram));
  };
  CHECK(islands(false).count() == 4);
  CHECK(islands(true).count() == 2);
  CHECK(islands(true).leaves == std::vector<std::vector<int>>{{0, 1}, {2, 3}});
  REQUIRE(islands(true).joins.size() == 2);
  CHECK(islands(true).joins[0].reader == "b.synapse");
}

TEST_CASE("events of an inner diagram are wired through its ports", "[event_wires]") {
  Network inner;
  inner.add(cell("cell", 2.0));
  const System& block = *inner.blocks.at("cell");
  inner.builder.export_event_output(block.event_output("fire"), "spike");
  inner.builder.export_event_input(block.event_input("synapse"));
  Network net;
  const auto group = std::make_shared<Diagram>(inner.builder.build("group"));
  CHECK(group->event_output_names() == std::vector<std::string>{"spike"});
  CHECK(group->event_input_names() == std::vector<std::string>{"cell_synapse"});
  net.builder.add(group);
  net.add(digits("digits")), net.add(beats("beats", {0.25}));
  net.builder.connect_event(group->event_output("spike"),
                            net.blocks.at("digits")->event_input("digit"), 3.0);
  net.builder.connect_event(net.blocks.at("beats")->event_output("beat"),
                            group->event_input("cell_synapse"), 1.5);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 0.5});
  CHECK(results.events.times("group.cell.fire") == std::vector<double>{0.25});
  CHECK(results.context.discrete_state()[0] == 3.0);
}

TEST_CASE("a wire from an event that never happens delivers nothing", "[event_wires]") {
  Network net;
  net.add(Leaf("still", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "never",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .direction = Direction::none});
  }));
  net.add(digits("digits"));
  net.wire("still", "never", "digits", "digit");
  const Diagram diagram = net.builder.build();
  CHECK(simulate(diagram, diagram.create_context(), {0.0, 2.0}).context.discrete_state()[0] == 0.0);
}

}  // namespace event_wires_plan_test
