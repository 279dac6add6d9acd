// Semantics 3.17 to 3.21: event wires between leaves.
#include "saltus/model/context_json.hpp"
#include "support/cells.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

using saltus::Delivery;

/// v from 0 under a current I reaches 1 after ln(I / (I - 1)).
double period(double current) { return std::log(current / (current - 1.0)); }

std::vector<double> times(const Results& results, std::string_view name) {
  return results.events.times(name);
}

}  // namespace

TEST_CASE("3.17 each firing of an event applies the reset map of its targets", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  Network net;
  net.add(cell("first", 2.0)), net.add(cell("second", 0.0)), net.add(cell("third", 0.0));
  net.wire("first", "fire", "second", "synapse", 0.25);
  net.wire("first", "fire", "third", "synapse", -0.5);
  const Diagram pair = net.builder.build();
  const auto results = simulate(pair, pair.create_context(), {0.0, 3.0},
                                {.ode_solver_method = method, .rtol = 1e-10, .atol = 1e-12});
  const double T = period(2.0);
  const auto fired = times(results, "first.fire");
  REQUIRE(fired.size() == 4);  // 3 / ln 2 = 4.3
  for (std::size_t k = 0; k < 4; ++k)
    CHECK_THAT(fired[k], WithinAbs(static_cast<double>(k + 1) * T, 1e-8));
  // A jump of w at k T decays with exp(T - t): the sum of four of them at t = 3.
  double sum = 0.0;
  for (int k = 1; k <= 4; ++k) sum += std::exp(k * T - 3.0);
  CHECK_THAT(results.context.continuous_state()[1], WithinAbs(0.25 * sum, 1e-8));
  CHECK_THAT(results.context.continuous_state()[2], WithinAbs(-0.5 * sum, 1e-8));
  CHECK(results.events.size() == 4);  // no row of the log for a delivery
}

TEST_CASE("3.17 each guard of a vector is a source, and each entry of an input a target",
          "[semantics]") {
  Network net;
  net.add(Leaf("ramps", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "levels",
                             .guard = [](const At& at, VectorRef out) {
                               out << at.x[0] - 1.0, at.x[0] - 2.0;
                             },
                             .size = 2});
  }));
  net.add(Leaf("sums", [](Leaf& l) {
    l.declare_discrete_state(vec({0.0, 0.0, 0.0}));
    l.declare_event_input({.name = "add",
                           .reset_map =
                               [](const At& at, Delivery& next) {
                                 Eigen::VectorXd z = at.z;
                                 z[at.entry] += next.weight() * at.time;
                                 next.set_discrete_state(z);
                               },
                           .size = 3});
  }));
  const System &from = *net.blocks.at("ramps"), &to = *net.blocks.at("sums");
  net.builder.connect_event(from.event_output("levels", 0), to.event_input("add", 2), 3.0);
  net.builder.connect_event(from.event_output("levels", 1), to.event_input("add", 0), 5.0);
  const Diagram diagram = net.builder.build();
  const auto z = simulate(diagram, diagram.create_context(), {0.0, 3.0}).context.discrete_state();
  CHECK_THAT(z[0], WithinAbs(10.0, 1e-9));  // 5 at t = 2
  CHECK(z[1] == 0.0);
  CHECK_THAT(z[2], WithinAbs(3.0, 1e-9));
}

TEST_CASE("3.17 a queued zero crossing fires where it is executed", "[semantics]") {
  Network net;
  net.add(Leaf("late", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "count",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map = count_up,
                             .delay = 0.5});
  }));
  net.add(digits("digits"));
  net.wire("late", "count", "digits", "digit", 7.0);
  const Diagram diagram = net.builder.build();
  const auto at = [&](double t) {
    return simulate(diagram, diagram.create_context(), {0.0, t}).context.discrete_state()[1];
  };
  CHECK(at(1.4) == 0.0);
  CHECK(at(1.6) == 7.0);
}

TEST_CASE("3.17 a delivery may change the mode of its leaf", "[semantics]") {
  Network net;
  net.add(beats("beats", {1.0}));
  net.add(Leaf("motor", [](Leaf& l) {
    l.declare_continuous_state(1, [](const At& at) { return at.mode == 1 ? 3.0 : 1.0; });
    l.declare_default_mode(0);
    l.declare_event_input({.name = "gear", .reset_map = [](const At&, Delivery& next) {
                             next.set_mode(static_cast<int>(next.weight()));
                           }});
  }));
  net.wire("beats", "beat", "motor", "gear", 1.0);
  const Diagram diagram = net.builder.build();
  const auto end = simulate(diagram, diagram.create_context(), {0.0, 2.0}).context;
  CHECK_THAT(end.continuous_state()[0], WithinAbs(4.0, 1e-12));
  CHECK(end.modes()[1] == 1);
}

TEST_CASE("3.17 a wire may lead back to its own leaf", "[semantics]") {
  Network net;
  net.add(cell("cell", 2.0));
  net.wire("cell", "fire", "cell", "synapse", 0.5);
  const Diagram diagram = net.builder.build();
  const auto found = times(simulate(diagram, diagram.create_context(), {0.0, 2.0}), "cell.fire");
  // After the first firing v begins at 1/2: from there 1 is ln((2 - 1/2) / (2 - 1)) away.
  REQUIRE(found.size() == 4);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK_THAT(found[k],
               WithinAbs(period(2.0) + static_cast<double>(k) * std::log(1.5), 1e-5));
}

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
  const std::string found = message<SimulationError>([&] {
    simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.zeno_tolerance = zeno});
  });
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
  const std::string found = message<SimulationError>(
      [&] { simulate(diagram, diagram.create_context(), {0.0, 2.0}); });
  INFO(found);
  CHECK(contains(found, "t = 1 s: this instant does not come to an end"));
}

TEST_CASE("3.19 deliveries of one pass follow each other in the order of their wires",
          "[semantics]") {
  // Three beats at one time, with delays that end at one time, and wires declared in mixed order.
  Network net;
  net.add(beats("a", {1.0})), net.add(beats("b", {1.0, 0.75})), net.add(digits("digits"));
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
  // At 1 s the delayed delivery, an update and a reset map belong to one pass.
  Network net;
  net.add(beats("beats", {0.5}));
  const auto append = [](double digit) {
    return [=](const At& at, Next& next) { next.set_discrete_state({10.0 * at.z[0] + digit}); };
  };
  net.add(Leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_event_input({.name = "digit", .reset_map = [](const At& at, Delivery& next) {
                             next.set_discrete_state({10.0 * at.z[0] + next.weight()});
                           }});
    l.declare_zero_crossing({.name = "one",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map = append(2.0)});
    l.declare_one_shot(1.0, append(1.0), "update");
  }));
  net.wire("beats", "beat", "leaf", "digit", 3.0, 0.5);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0});
  const double z = results.context.discrete_state()[0];
  // The guard may be located a rounding before or after the tick: then it is an instant of its own.
  CHECK((z == 123.0 || z == 213.0 || z == 132.0));
  CHECK(results.events.size() == 3);
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

TEST_CASE("3.20 a run that is cut while deliveries wait is the unbroken run", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool islands = GENERATE(false, true);
  INFO("method " << method << ", islands " << islands);
  Network net;
  net.add(cell("a", 2.0)), net.add(cell("b", 1.25)), net.add(cell("c", 2.0)), net.add(digits("d"));
  net.wire("a", "fire", "b", "synapse", 0.25, 0.9), net.wire("b", "fire", "a", "synapse", -0.5, 0.3);
  net.wire("a", "fire", "b", "synapse", 0.125), net.wire("c", "fire", "d", "digit", 1.0, 1.1);
  const Diagram diagram = net.builder.build();
  const SimulatorOptions options{.ode_solver_method = method, .islands = islands};
  Context context = diagram.create_context();
  // Pieces by hand are other steps; the events are those of the unbroken run to the tolerance, and
  // the continuation is exact: the same pieces with contexts that were written and read.
  Context saved = context;
  for (double stop = 0.5; stop <= 4.0; stop += 0.5) {
    context = simulate(diagram, context, {context.time(), stop}, options).context;
    saved = context_from_json(diagram, to_json(simulate(diagram, saved, {saved.time(), stop}, options).context));
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

TEST_CASE("3.21 a firing without an effect makes no row, and a delivery makes one", "[semantics]") {
  Network net;
  net.add(Leaf("ramp", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "one", .guard = [](const At& at) { return at.x[0] - 1.0; }});
  }));
  net.add(digits("digits"));
  net.wire("ramp", "one", "digits", "digit", 2.0, 0.5);
  const Diagram diagram = net.builder.build();
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 2.0},
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
