// Semantics 3.20 and 3.21: deliveries after a delay, and what restarts.
#include "support/cells.hpp"

namespace event_wires_delay_test {

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using saltus::Delivery;

namespace {

std::vector<double> times(const Results& results, std::string_view name) {
  return results.events.times(name);
}

}  // namespace

TEST_CASE("3.20 a delayed delivery is an exact stop at its time", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  Network net;
  net.add(cell("first", 2.0)), net.add(cell("second", 0.0));
  net.wire("first", "fire", "second", "synapse", 1.5, 1.0);  // longer than a period: two wait
  const Diagram pair = net.builder.build();
  const auto results =
      simulate(pair, pair.create_context(), {0.0, 4.0}, {.ode_solver_method = method});
  const auto fired = times(results, "first.fire"), arrived = times(results, "second.fire");
  REQUIRE(arrived.size() == 4);
  for (std::size_t k = 0; k < arrived.size(); ++k) CHECK(arrived[k] == fired[k] + 1.0);
}

TEST_CASE("3.20 deliveries that are due at one time are one pass", "[semantics]") {
  // 0.1 + 0.2 and 0.3 differ by a rounding.
  Network net;
  net.add(beats("a", {0.1})), net.add(beats("b", {0.3})), net.add(digits("digits"));
  net.wire("a", "beat", "digits", "digit", 1.0, 0.2), net.wire("b", "beat", "digits", "digit", 2.0);
  net.wire("b", "beat", "digits", "digit", 3.0, 0.7);
  net.wire("a", "beat", "digits", "digit", 4.0, 0.9);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0});
  CHECK(results.context.discrete_state()[0] == 1234.0);
  CHECK(results.context.continuation()->jump == 4);  // two beats, of which one has a delivery with
                                                     // it; the delivery of b; both at 1 s
}

TEST_CASE("3.20 a delay within rounding of the time is no time", "[semantics]") {
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 0.0));
  net.wire("a", "fire", "b", "synapse", 1.5, 1e-300);
  net.wire("b", "fire", "a", "synapse", -1.0);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 1.0});
  REQUIRE(results.events.size() == 2);
  CHECK(results.events[0].time == results.events[1].time);
  CHECK(results.context.continuation()->jump == 4);
}

TEST_CASE("3.20 a terminal firing is delivered at its own time, and waits where it has a delay",
          "[semantics]") {
  Network net;
  net.add(Leaf("ramp", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "end", .guard = [](const At& at) { return at.x[0] - 1.0; }, .terminal = true});
  }));
  net.add(digits("digits"));
  net.wire("ramp", "end", "digits", "digit", 4.0),
      net.wire("ramp", "end", "digits", "digit", 5.0, 2.0);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 9.0});
  CHECK(results.status == Status::terminal);
  CHECK(results.context.discrete_state()[0] == 4.0);
  REQUIRE(results.context.pending() != nullptr);
  CHECK(results.context.pending()->deliveries.size() == 1);
}

TEST_CASE("3.21 a firing without an effect makes no row, and a delivery makes one", "[semantics]") {
  Network net;
  net.add(Leaf("ramp", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "one", .guard = [](const At& at) { return at.x[0] - 1.0; }});
  }));
  net.add(digits("digits"));
  net.wire("ramp", "one", "digits", "digit", 2.0, 0.5);
  const Diagram diagram = net.builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0},
               {.recorded_signals = {{"z", net.blocks.at("digits")->output("z")}}});
  CHECK(results.jump.back() == 1);
  CHECK(results.events.size() == 1);
  CHECK(results.events[0].jump == 0);
  CHECK(results.context.discrete_state()[0] == 2.0);
  CHECK(std::ranges::count(results.time, results.events[0].time + 0.5) == 2);
}

TEST_CASE("3.21 a delivery restarts the solver only if continuous state was written",
          "[semantics]") {
  const auto restarts = [](bool state) {
    Network net;
    net.add(beats("beats", {1.0, 2.0, 3.0})), net.add(cell("cell", 0.5)), net.add(digits("digits"));
    net.wire("beats", "beat", state ? "cell" : "digits", state ? "synapse" : "digit", 0.125);
    const Diagram diagram = net.builder.build();
    return simulate(diagram, diagram.create_context(), {0.0, 4.0},
                    {.ode_solver_method = Method::adams})
        .statistics.restarts;
  };
  CHECK(restarts(true) == restarts(false) + 3);
}

}  // namespace event_wires_delay_test
