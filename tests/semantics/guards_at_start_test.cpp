// Semantics 2.4: what `at_start` makes of a guard at zero, or on its firing side, at the start.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// x' = -1 from `start`, a falling guard at 0 that counts.
Leaf falling(double start, AtStart at_start, bool terminal = false) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, -1.0, start);
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive,
                             .terminal = terminal,
                             .at_start = at_start});
  });
}

std::vector<double> hits(const Leaf& leaf, Method method) {
  return simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method})
      .events.times("hit");
}

/// x' = -1 from 1, in mode 1 from x = 0.5 on; there a falling guard at `level`.
Leaf entering(double level, AtStart at_start) {
  return Leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, -1.0, 1.0);
    l.declare_discrete_state(vec({0.0}));
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "enter",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "hit",
                             .guard = [=](const At& at) { return at.x[0] - level; },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 1,
                             .at_start = at_start});
  });
}

}  // namespace

TEST_CASE("2.4 auto: on its firing side at the start a guard waits, at zero it is in contact",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  CHECK(hits(falling(-0.5, AtStart::automatic), method).empty());
  CHECK(hits(falling(0.0, AtStart::automatic), method) == std::vector{0.0});
  CHECK(ZeroCrossing{}.at_start == AtStart::automatic);
}

TEST_CASE("2.4 a guard on its firing side at the start fires when it comes back from the other",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto at_start = GENERATE(AtStart::automatic, AtStart::ignore);
  INFO("method " << method);
  const Leaf leaf("swing", [=](Leaf& l) {  // x = -cos t
    l.declare_continuous_state(
        {.initial = vec({-1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing({.name = "hit",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = Direction::positive_then_non_positive,
                             .at_start = at_start});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 6.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  const auto found = results.events.times("hit");
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(1.5 * std::acos(-1.0), 1e-6));
}

TEST_CASE("2.4 at_start \"ignore\" waits, at zero and beyond it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double start = GENERATE(0.0, -0.5);
  INFO("method " << method << ", start " << start);
  CHECK(hits(falling(start, AtStart::ignore), method).empty());
}

TEST_CASE("2.4 at_start \"fire\" fires at t0, at zero and beyond it", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double start = GENERATE(0.0, -0.5);
  INFO("method " << method << ", start " << start);
  CHECK(hits(falling(start, AtStart::fire), method) == std::vector{0.0});
  CHECK(hits(falling(start, AtStart::fire, true), method) == std::vector{0.0});  // and ends it:
  const Leaf leaf = falling(start, AtStart::fire, true);
  const auto ended = simulate(leaf, leaf.create_context(), {0.0, 1.0});
  CHECK(ended.status == Status::terminal);
  CHECK(ended.context.time() == 0.0);
}

TEST_CASE("2.4 at_start \"error\" is an error that names the guard, at zero and beyond it",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double start = GENERATE(0.0, -0.5);
  const auto what = message<SimulationError>([&] { hits(falling(start, AtStart::error), method); });
  INFO("method " << method << ", start " << start << ": " << what);
  CHECK(contains(what, "hit"));
  CHECK(contains(what, "at_start"));
}

TEST_CASE("2.4 no at_start says anything about a guard on its armed side", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto at_start =
      GENERATE(AtStart::automatic, AtStart::ignore, AtStart::fire, AtStart::error);
  INFO("method " << method);
  const auto found = hits(falling(0.5, at_start), method);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(0.5, 1e-9));
}

TEST_CASE("2.4 at_start counts where a mode is entered too", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double level = GENERATE(0.75, 0.5);  // beyond it, and at it, when mode 1 is entered
  INFO("method " << method << ", level " << level);
  CHECK(hits(entering(level, AtStart::automatic), method).empty());
  CHECK(hits(entering(level, AtStart::ignore), method).empty());
  const auto found = hits(entering(level, AtStart::fire), method);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0], WithinAbs(0.5, 1e-9));
  CHECK(contains(message<SimulationError>([&] { hits(entering(level, AtStart::error), method); }),
                 "at_start"));
}

TEST_CASE("2.4 at_start has four names", "[semantics]") {
  for (const auto& [name, value] : at_start_names) CHECK(at_start_from(name) == value);
  CHECK(contains(message<ModelError>([] { at_start_from("automatic"); }), "auto"));
}
