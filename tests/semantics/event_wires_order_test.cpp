// Semantics 3.18 and 3.19: the passes of deliveries, and their order.
#include "support/cells.hpp"

namespace event_wires_order_test {

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using saltus::Delivery;

TEST_CASE("3.18 a delivery without delay is in the pass after the firing", "[semantics]") {
  constexpr int n = 20;
  Network net;
  net.add(beats("beats", {1.0}));
  for (int k = 0; k < n; ++k) net.add(cell(text("cell ", k), 0.0));
  net.wire("beats", "beat", "cell 0", "synapse", 2.0);
  for (int k = 1; k < n; ++k)
    net.wire(text("cell ", k - 1), "fire", text("cell ", k), "synapse", 2.0);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0});
  REQUIRE(results.events.size() == n + 1);
  // Pass 1 is the beat, pass 2 its delivery, pass 3 the firing of cell 0, pass 4 its delivery, ...
  CHECK(results.events[0].jump == 1);
  for (int k = 0; k < n; ++k) {
    const Event event = results.events[static_cast<std::size_t>(k + 1)];
    CHECK(event.block == text("cell ", k));
    CHECK(event.time == 1.0);
    CHECK(event.jump == 3 + 2 * k);
  }
  CHECK(results.context.continuous_state().isZero());
}

TEST_CASE("3.18 an endless cascade is an error with the chain of causes", "[semantics]") {
  const double zeno = GENERATE(0.0, 1e-6);
  INFO("zeno_tolerance " << zeno);
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 0.0));
  net.wire("a", "fire", "b", "synapse", 1.5), net.wire("b", "fire", "a", "synapse", 1.5);
  const Diagram diagram = net.builder.build();
  const std::string found = message<SimulationError>(
      [&] { simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.zeno_tolerance = zeno}); });
  INFO(found);
  CHECK(contains(found, "this instant does not come to an end: more than 100 passes"));
  CHECK(contains(found, "'a.fire' -> 'b.fire' -> 'a.fire'"));
}

TEST_CASE("3.18 an endless cascade that writes nothing is an error too", "[semantics]") {
  Network net;
  net.add(beats("beats", {1.0}));
  net.add(Leaf("loop", [](Leaf& l) {
    declare_ramp(l);
    l.declare_default_mode(1);
    l.declare_mode_output("m");
    for (const double side : {1.0, -1.0}) {
      l.declare_zero_crossing({.name = side > 0.0 ? "up" : "down",
                               .guard = [=](const At& at) { return side * at.mode; },
                               .direction = Direction::negative_then_non_negative});
    }
    l.declare_event_input({.name = "turn", .reset_map = [](const At& at, Delivery& next) {
                             next.set_mode(-at.mode);
                           }});
  }));
  net.wire("beats", "beat", "loop", "turn");
  for (const char* name : {"up", "down"}) net.wire("loop", name, "loop", "turn");
  const Diagram diagram = net.builder.build();
  const std::string found =
      message<SimulationError>([&] { simulate(diagram, diagram.create_context(), {0.0, 2.0}); });
  INFO(found);
  CHECK(contains(found, "t = 1 s: this instant does not come to an end"));
}

TEST_CASE("3.19 deliveries of one pass follow each other in the order of their wires",
          "[semantics]") {
  // Three beats at one time, with delays that end at one time, and wires declared in mixed order.
  Network net;
  net.add(beats("a", {1.0})), net.add(beats("b", {0.75, 1.0})), net.add(digits("digits"));
  net.wire("b", "beat", "digits", "digit", 1.0, 0.25);
  net.wire("a", "beat", "digits", "digit", 2.0, 0.25);
  net.wire("a", "beat", "digits", "digit", 3.0);
  net.wire("b", "beat", "digits", "digit", 4.0);
  net.wire("a", "beat", "digits", "digit", 5.0);
  const Diagram diagram = net.builder.build();
  const auto at = [&](double t) {
    return simulate(diagram, diagram.create_context(), {0.0, t}).context.discrete_state()[0];
  };
  CHECK(at(0.8) == 4.0);
  // At 1 s: wire 0, of the firing at 0.75 s, comes with the beats; wires 2, 3, 4 in the next pass.
  CHECK(at(1.1) == 41345.0);
  CHECK(at(1.3) == 4134512.0);
}

TEST_CASE("3.19 a delivery comes after the updates and reset maps of its leaf", "[semantics]") {
  const double delay = GENERATE(0.0, 0.5);
  INFO("delay " << delay);
  const auto append = [](double digit) {
    return [=](const At& at, Next& next) { next.set_discrete_state({10.0 * at.z[0] + digit}); };
  };
  Network net;
  net.add(Leaf("leaf", [&](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_event_input({.name = "digit", .reset_map = [](const At& at, Delivery& next) {
                             next.set_discrete_state({10.0 * at.z[0] + next.weight()});
                           }});
    l.declare_zero_crossing({.name = "passed",
                             .guard = [](const At& at) { return at.z[0] - 0.5; },
                             .reset_map = append(2.0),
                             .direction = Direction::negative_then_non_negative});
    l.declare_one_shot(1.0, append(1.0), "update");
  }));
  net.add(beats("beats", {1.0 - delay}));
  net.wire("beats", "beat", "leaf", "digit", 3.0, delay);
  const Diagram diagram = net.builder.build();
  const double z =
      simulate(diagram, diagram.create_context(), {0.0, 2.0}).context.discrete_state()[0];
  // The update is in the first pass, and moves the guard, which fires in the second. The delivery is
  // in the second pass, after the reset map, or with its delay in the first, after the update.
  CHECK(z == (delay == 0.0 ? 123.0 : 132.0));
}

TEST_CASE("3.19 a delivery reads the other leaves as they were before the pass", "[semantics]") {
  Network net;
  net.add(beats("beats", {1.0})), net.add(digits("other"));
  net.add(Leaf("reader", [](Leaf& l) {
    l.declare_input_port({.name = "u"});
    l.declare_discrete_state(vec({-1.0}));
    l.declare_event_input({.name = "read", .reset_map = [](const At& at, Delivery& next) {
                             next.set_discrete_state({at.u(0)});
                           }});
  }));
  net.builder.connect(net.blocks.at("other")->output("z"), net.blocks.at("reader")->input("u"));
  net.wire("beats", "beat", "other", "digit", 5.0), net.wire("beats", "beat", "reader", "read");
  const Diagram diagram = net.builder.build();
  const auto z = simulate(diagram, diagram.create_context(), {0.0, 2.0}).context.discrete_state();
  CHECK(z[0] == 5.0);
  CHECK(z[1] == 0.0);
}

}  // namespace event_wires_order_test
