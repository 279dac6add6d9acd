// Semantics 5.5: every run ends in exactly one status; the bad ones raise, with all there is.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 with a guard at 1 that does what a test says.
Leaf ramp(bool terminal, double bad_from = infinite) {
  return Leaf("ramp", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [=](const At& at) {
                                  return at.x[0] > bad_from ? not_a_number : 1.0;
                                }});
    l.declare_zero_crossing(
        {.name = "one", .guard = [](const At& at) { return at.x[0] - 1.0; }, .terminal = terminal});
  });
}

struct Ending {
  const char* what;
  Status status;
  std::function<Results(SimulatorOptions)> run;
};

std::vector<Ending> endings() {
  const auto end = [](const System& system, SimulatorOptions options) {
    return simulate(system, system.create_context(), {0.0, 2.0}, options);
  };
  return {{"the end", Status::reached_end, [=](auto o) { return end(ramp(false), o); }},
          {"a terminal event", Status::terminal, [=](auto o) { return end(ramp(true), o); }},
          {"too many major steps", Status::step_limit,
           [=](auto o) {
             return o.max_major_steps = 1, o.max_major_step_length = 0.1, end(ramp(false), o);
           }},
          {"a ball without monitor", Status::chattering,
           [=](auto o) {
             o.zeno_tolerance = 0.0;
             const BallScene scene = leaf({.e = 0.5});
             return simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 3.0}, o);
           }},
          {"an interrupt", Status::interrupted,
           [=](auto o) {
             o.interrupt = [] { return true; };
             const Leaf leaf = ramp(false);
             return simulate(leaf, leaf.create_context(), {0.0, 1e9},
                             (o.max_minor_step_size = 1e-3, o));
           }},
          {"a derivative that is NaN", Status::failed,
           [=](auto o) { return end(ramp(false, 0.5), o); }}};
}

}  // namespace

TEST_CASE("5.5 every run ends in one status, and only the good ones end without an error",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Ending& ending : endings()) {
    INFO(ending.what << ", method " << method);
    const auto quiet = ending.run({.ode_solver_method = method, .throw_errors = false});
    CHECK(to_string(quiet.status) == to_string(ending.status));
    CHECK(quiet.message.empty() == ended_well(ending.status));
    try {
      const auto loud = ending.run({.ode_solver_method = method});
      CHECK(ended_well(ending.status));
      CHECK(loud.status == ending.status);
    } catch (const SimulationError& error) {
      CHECK(!ended_well(ending.status));
      REQUIRE(error.results());
      CHECK(error.results()->status == ending.status);
      // A step that fails does so a rounding behind the last one that did not.
      CHECK(std::abs(error.results()->context.time() - error.time()) < 1e-9);
      CHECK(contains(error.what(), text("t = ", error.time())));
    }
  }
}

TEST_CASE("5.5 the names of the seven statuses", "[semantics]") {
  const std::vector<std::string> names{"reached_end", "terminal",    "zeno_stop", "step_limit",
                                       "chattering",  "interrupted", "failed"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(to_string(static_cast<Status>(i)) == names[i]);
    CHECK(ended_well(static_cast<Status>(i)) == (i < 3));
  }
}

TEST_CASE("6.2 a derivative that is NaN from some state on is named with its block",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = ramp(false, 0.5);
  try {
    simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
    FAIL("no exception");
  } catch (const SimulationError& error) {
    CHECK(error.block() == "ramp");
    CHECK(contains(error.what(), "ramp"));
  }
}
