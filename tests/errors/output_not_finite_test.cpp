// NaN or Inf from a recorded output is a SimulationError that names the block.

#include "support/leaves.hpp"
#include "support/quiet.hpp"

using namespace saltus;
using namespace support;

namespace {

struct Ended {
  std::string message, printed, block;
  double time = not_a_number;
  bool partial = false;
};

/// Runs to t = 2 and reports how a SimulationError ended it.
Ended run(const System& system, Method method, SimulatorOptions options = {}) {
  Ended ended;
  options.ode_solver_method = method;
  ended.printed = printed_by([&] {
    try {
      simulate(system, system.create_context(), {0.0, 2.0}, options);
      ended.message = "no exception";
    } catch (const SimulationError& error) {
      ended.message = error.what(), ended.time = error.time(), ended.block = error.block();
      ended.partial = error.results() != nullptr;
    } catch (const std::exception& error) {
      ended.message = std::string("another exception: ") + error.what();
    }
  });
  return ended;
}

}  // namespace

TEST_CASE("a recorded output that is NaN is an error that names it", "[errors]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_output_port(
        {.name = "log", .calc = [](const At& at) { return at.time > 1.0 ? not_a_number : 1.0; }});
  });
  const Ended ended = run(leaf, method, {.recorded_signals = {{"log", leaf.output("log")}}});
  INFO(ended.message);
  CHECK(contains(ended.message, "'leaf.log'"));
  CHECK(contains(ended.message, "not finite"));
}
