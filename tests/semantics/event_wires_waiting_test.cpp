// Semantics 3.20, 4.7 and 5.6b: runs that are cut while deliveries wait, and deliveries without end.
#include "saltus/model/context_json.hpp"
#include "support/cells.hpp"

namespace event_wires_waiting_test {

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using saltus::Delivery;

TEST_CASE("3.20 a run that is cut while deliveries wait is the unbroken run", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool islands = GENERATE(false, true);
  INFO("method " << method << ", islands " << islands);
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 1.25)), net.add(cell("c", 2.0)), net.add(digits("d"));
  net.wire("a", "fire", "b", "synapse", 0.25, 0.9),
      net.wire("b", "fire", "a", "synapse", -0.5, 0.3);
  net.wire("a", "fire", "b", "synapse", 0.125), net.wire("c", "fire", "d", "digit", 1.0, 1.1);
  const Diagram diagram = net.builder.build();
  const SimulatorOptions options{.ode_solver_method = method, .islands = islands};
  Context context = diagram.create_context();
  // Pieces by hand are other steps; the events are those of the unbroken run to the tolerance, and
  // the continuation is exact: the same pieces with contexts that were written and read.
  Context saved = context;
  for (double stop = 0.5; stop <= 4.0; stop += 0.5) {
    context = simulate(diagram, context, {context.time(), stop}, options).context;
    saved = context_from_json(
        diagram, to_json(simulate(diagram, saved, {saved.time(), stop}, options).context));
    CHECK(saved.continuous_state() == context.continuous_state());
    CHECK(saved.discrete_state() == context.discrete_state());
    REQUIRE((saved.pending() != nullptr) == (context.pending() != nullptr));
    if (context.pending() != nullptr) CHECK(*saved.pending() == *context.pending());
  }
  const auto whole = simulate(diagram, diagram.create_context(), {0.0, 4.0}, options);
  CHECK(whole.context.pending()->deliveries.size() == context.pending()->deliveries.size());
  CHECK(whole.context.discrete_state() == context.discrete_state());
  CHECK((whole.context.continuous_state() - context.continuous_state()).norm() < 1e-3);
}

TEST_CASE("4.7 deliveries that set each other off after a delay too short for the time chatter",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double delay = GENERATE(1e-15, 1e-12);  // the second: no state moves by its tolerance
  INFO("method " << method << ", " << delay << " s");
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 0.0));
  net.wire("a", "fire", "b", "synapse", 1.5, delay);
  net.wire("b", "fire", "a", "synapse", 1.5, delay);
  const Diagram diagram = net.builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 9.0},
               {.ode_solver_method = method, .max_major_steps = 100'000, .throw_errors = false});
  CHECK(results.status == Status::chattering);
  INFO(results.message);
  CHECK(contains(results.message, "executions, or deliveries, follow each other"));
}

TEST_CASE("5.6b deliveries whose time is past happen at the start", "[semantics]") {
  Network net;
  net.add(beats("beats", {1.0})), net.add(digits("digits"));
  net.wire("beats", "beat", "digits", "digit", 6.0, 5.0);
  const Diagram diagram = net.builder.build();
  const Context cut = simulate(diagram, diagram.create_context(), {0.0, 2.0}).context;
  REQUIRE(cut.pending() != nullptr);
  CHECK(cut.pending()->deliveries == std::vector<PendingDelivery>{{0, 0, 0, 5.0, 6.0}});
  CHECK(simulate(diagram, cut, {2.0, 6.0}).context.discrete_state()[0] == 6.0);
  const auto late = simulate(diagram, cut.with_time(9.0), {9.0, 9.5});
  CHECK(late.context.discrete_state()[0] == 6.0);
  CHECK(late.context.pending() == nullptr);
}

}  // namespace event_wires_waiting_test
