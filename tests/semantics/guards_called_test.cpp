// Semantics 2.7: a guard is called only if it can fire; without guards there is no root-finding.
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// An oscillator with the guards that `declare` adds.
template <class Declare>
Leaf oscillator(Declare declare) {
  return Leaf("oscillator", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_continuous_state_output("x");
    declare(l);
  });
}

}  // namespace

TEST_CASE("2.7 a scene without guards never asks for guards", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = oscillator([](Leaf&) {});
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(results.statistics.guard_calls == 0);
  CHECK(contains(compile(leaf)->describe(), "no guards: no root-finding"));
}

TEST_CASE("2.7 a guard of direction none is never called", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  int calls = 0;
  const Leaf leaf = oscillator([&](Leaf& l) {
    l.declare_zero_crossing(
        {.guard = [&](const At& at) { return ++calls, at.x[0]; }, .direction = Direction::none});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(calls == 0);
  CHECK(results.statistics.guard_calls == 0);
  CHECK(contains(compile(leaf)->describe(), "no guards"));
}

TEST_CASE("2.7 a guard is not called outside its mode", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  int wrong = 0, right = 0;
  const Leaf leaf = oscillator([&](Leaf& l) {
    l.declare_default_mode(0);
    for (int m = 0; m < 2; ++m) {
      l.declare_zero_crossing(
          {.name = text("from_", m),
           .guard = [&wrong, &right,
                     m](const At& at) { return ++(at.mode == m ? right : wrong), at.x[0]; },
           .start_mode = m,
           .end_mode = 1 - m});
    }
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 20.0}, {.ode_solver_method = method});
  CHECK(results.events.size() == 6);
  CHECK(wrong == 0);
  CHECK(right > 0);
}
