// Semantics 3.17: what event wires deliver.
#include "support/cells.hpp"

namespace event_wires_test {

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using saltus::Delivery;

namespace {

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
                                {.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method});
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
    l.declare_zero_crossing(
        {.name = "levels",
         .guard = [](const At& at, VectorRef out) { out << at.x[0] - 1.0, at.x[0] - 2.0; },
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
    CHECK_THAT(found[k], WithinAbs(period(2.0) + static_cast<double>(k) * std::log(1.5), 1e-5));
}

}  // namespace event_wires_test
