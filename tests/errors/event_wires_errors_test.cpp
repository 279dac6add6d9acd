// Errors of event wires: what was expected, what was found, and where.
#include "saltus/library/subsystems.hpp"
#include "support/cells.hpp"

namespace event_wires_errors_test {

using namespace saltus;
using namespace support;

namespace {

/// The message of an act on a network of two cells.
template <class Act>
std::string refusal(const Act& act) {
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 0.0));
  return message<ModelError>([&] { act(net); });
}

}  // namespace

TEST_CASE("unknown events and event inputs are answered with the nearest name", "[errors]") {
  CHECK(refusal([](Network& net) { net.wire("a", "fires", "b", "synapse"); }) ==
        "block 'a' has no event that a wire may start from, 'fires'; did you mean 'fire'? Known: "
        "'fire'");
  CHECK(contains(refusal([](Network& net) { net.wire("a", "fire", "b", "synapses"); }),
                 "block 'b' has no event input 'synapses'; did you mean 'synapse'?"));
  CHECK(
      contains(refusal([](Network& net) { net.blocks.at("a")->event_output("fire", 1); }),
               "block 'a': event 'fire' has 1 entry; expected the number of one, 0 to 0, found 1"));
}

TEST_CASE("weights and delays have to be finite, and delays not negative", "[errors]") {
  for (const double weight : {not_a_number, infinite}) {
    CHECK(contains(refusal([&](Network& net) { net.wire("a", "fire", "b", "synapse", weight); }),
                   "event wire from 'a.fire' to 'b.synapse': weight"));
  }
  for (const double delay : {not_a_number, infinite, -1e-3}) {
    const std::string found =
        refusal([&](Network& net) { net.wire("a", "fire", "b", "synapse", 1.0, delay); });
    CHECK(contains(found, "event wire from 'a.fire' to 'b.synapse': delay"));
    CHECK(contains(found, "expected a finite time >= 0 s"));
  }
}

TEST_CASE("a wire to a block outside of the diagram is refused", "[errors]") {
  const Leaf other = cell("other", 1.0);
  CHECK(contains(refusal([&](Network& net) {
                   net.builder.connect_event(net.blocks.at("a")->event_output("fire"),
                                             other.event_input("synapse"));
                 }),
                 "block 'other' was not added to this diagram"));
  CHECK(contains(refusal([&](Network& net) {
                   net.builder.connect_event({}, net.blocks.at("a")->event_input("synapse"));
                 }),
                 "the port belongs to no block"));
}

TEST_CASE("several entries of which none is named are refused", "[errors]") {
  Network net;
  net.add(beats("beats", {1.0}));
  net.add(Leaf("many", [](Leaf& l) {
    l.declare_event_input({.name = "in", .reset_map = [](const At&, Delivery&) {}, .size = 3});
  }));
  const std::string found = message<ModelError>([&] { net.wire("beats", "beat", "many", "in"); });
  CHECK(contains(found,
                 "block 'many': event input 'in' has 3 entries; expected the number of one, "
                 "0 to 2, found none"));
}

TEST_CASE("declarations of event inputs are checked", "[errors]") {
  const auto declared = [](EventInputDeclaration input) {
    return message<ModelError>([&] {
      const Leaf leaf("leaf",
                      [&](Leaf& l) { l.declare_event_input(input), l.declare_event_input(input); });
    });
  };
  const DeliveryMap map = [](const At&, Delivery&) {};
  CHECK(contains(declared({.name = "in"}), "event input 'in' has no reset map"));
  CHECK(contains(declared({.name = "in", .reset_map = map, .size = 0}), "has 0 entries"));
  CHECK(contains(declared({.name = "a.b", .reset_map = map}), "a dot separates"));
  CHECK(contains(declared({.name = "in", .reset_map = map}), "the name 'in' is declared twice"));
}

TEST_CASE("a delivery that sets a state that is not finite names block, input and time",
          "[errors]") {
  Network net;
  net.add(beats("beats", {1.0}));
  net.add(Leaf("cell", [](Leaf& l) {
    declare_ramp(l);
    l.declare_event_input({.name = "in", .reset_map = [](const At&, Delivery& next) {
                             next.set_continuous_state({not_a_number});
                           }});
  }));
  net.wire("beats", "beat", "cell", "in");
  const Diagram diagram = net.builder.build();
  CHECK(contains(
      message<SimulationError>([&] { simulate(diagram, diagram.create_context(), {0.0, 2.0}); }),
      "t = 1 s: 'cell.in' set a state that is not finite"));
}

TEST_CASE("a delivery that waits in a context has to fit the system", "[errors]") {
  Network net;
  net.add(beats("beats", {1.0})), net.add(digits("digits"));
  net.wire("beats", "beat", "digits", "digit", 6.0, 5.0);
  const Diagram diagram = net.builder.build();
  const Context cut = simulate(diagram, diagram.create_context(), {0.0, 2.0}).context;
  const auto refused = [&](PendingDelivery delivery, bool islands = false) {
    ContextValues values = cut.values();
    PendingExecutions pending = *values.pending;
    pending.deliveries = {delivery};
    values.pending = std::make_shared<const PendingExecutions>(pending);
    return message<ModelError>([&] {
      simulate(diagram, cut.with_values(values).with_time(2.0), {2.0, 3.0}, {.islands = islands});
    });
  };
  for (const bool islands : {false, true}) {
    CHECK(contains(refused({0, 0, 0, 4.0, 6.0}, islands),
                   "a delivery waits of event 0, entry 0, of block 'beats', from which no event "
                   "wire with a delay of 4 s starts"));
    CHECK(contains(refused({1, 0, 0, 5.0, 6.0}, islands), "of block 'digits'"));
  }
  CHECK(contains(refused({7, 0, 0, 5.0, 6.0}), "a delivery of block 7 of 2"));
  CHECK(contains(refused({0, 0, 0, -5.0, 6.0}), "a delivery with a delay of -5 s"));
  CHECK(contains(refused({0, 0, 0, 5.0, infinite}), "a delivery that is due at inf s"));
}

}  // namespace event_wires_errors_test
