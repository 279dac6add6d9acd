// Semantics 3.9: terminal events, and the n-th firing of one.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A swing x = sin t that ends at its n-th way up through `level`.
Leaf swing(int n, double level) {
  return Leaf("swing", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.0, 1.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "up",
                             .guard = [=](const At& at) { return at.x[0] - level; },
                             .reset_map = count_up,
                             .direction = Direction::negative_then_non_negative,
                             .terminal = true,
                             .max_count = n});
  });
}

}  // namespace

TEST_CASE("3.9 max_count: a terminal event ends the run on its n-th firing", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const int n = GENERATE(1, 3);
  INFO("method " << method << ", n = " << n);
  const Leaf leaf = swing(n, 0.5);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 100.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  const double pi = std::acos(-1.0);
  CHECK(results.status == Status::terminal);
  CHECK_THAT(results.context.time(), WithinAbs(pi / 6.0 + 2.0 * pi * (n - 1), 1e-6));
  CHECK(results.context.discrete_state()[0] == n);  // each firing applied its reset map
  CHECK(count(results.events, EventKind::terminal) == 1);
  CHECK(count(results.events, EventKind::zero_crossing) == n - 1);
}

TEST_CASE("3.9 a run that is continued goes on counting", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = swing(3, 0.5);
  Simulator simulator(leaf, {.ode_solver_method = method});
  simulator.initialize(leaf.create_context());
  CHECK(simulator.advance_to(5.0) == Status::reached_end);
  CHECK(simulator.advance_to(10.0) == Status::reached_end);
  CHECK(simulator.advance_to(20.0) == Status::terminal);
}

TEST_CASE("3.9 max_count below 1, or on a guard that is not terminal, is refused", "[semantics]") {
  const auto refused = [](int n, bool terminal) {
    return message<ModelError>([=] {
      const Leaf leaf("leaf", [=](Leaf& l) {
        declare_ramp(l);
        l.declare_zero_crossing({.name = "hit",
                                 .guard = [](const At& at) { return at.x[0]; },
                                 .terminal = terminal,
                                 .max_count = n});
      });
    });
  };
  CHECK(contains(refused(0, true), "max_count"));
  CHECK(contains(refused(2, false), "max_count"));
}

TEST_CASE("3.9 firings of one vector of guards at one time are counted one by one", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const int max_count = GENERATE(1, 2, 3);
  INFO("method " << method << ", max_count " << max_count);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "end",
         .guard = [](const At& at, VectorRef out) { out.setConstant(at.x[0] - 0.5); },
         .terminal = true,
         .max_count = max_count,
         .size = 2});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(results.status == (max_count < 3 ? Status::terminal : Status::reached_end));
  CHECK(results.events.size() == 2);
}
