// SeenGuards: a guard can fire in the start mode that it has, and while all control signals of its
// block are true.
#include "saltus/plan/detail/seen_guards.hpp"

#include <memory>
#include <optional>

#include "saltus/library/pulse.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Guards that are seen in every mode, in mode 0 and in mode 1.
void declare_guards(Leaf& leaf) {
  declare_ramp(leaf);
  leaf.declare_default_mode(0);
  for (const std::optional<int> mode : {std::optional<int>(), std::optional(0), std::optional(1)})
    leaf.declare_zero_crossing({.name = mode ? text("in mode ", *mode) : "always",
                                .guard = [](const At& at) { return at.x[0] - 1.0; },
                                .start_mode = mode});
}

/// The guards that can fire after the choice by the present values.
std::vector<int> chosen(SeenGuards& seen) {
  seen.select(false);
  return seen.groups();
}

}  // namespace

TEST_CASE("a guard is seen in every mode, or in its start mode") {
  const Leaf leaf("leaf", declare_guards);
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  SeenGuards seen(machine);
  CHECK(chosen(seen) == std::vector{0, 1});
  CHECK(seen.single() == seen.groups());  // the plan computes nothing together
  machine.modes[0] = 1;
  CHECK(chosen(seen) == std::vector{0, 2});
  machine.modes[0] = 2;
  CHECK(chosen(seen) == std::vector{0});
}

TEST_CASE("the guards of a part are seen while its control signal is true") {
  DiagramBuilder builder;
  const auto leaf = std::make_shared<Leaf>("leaf", declare_guards);
  builder.add(leaf);
  const auto& pulse = builder.add<Pulse>("pulse", PulseOptions{.period = 2.0, .phase_delay = 1.0});
  builder.execute(*leaf, pulse.output(), {});
  const Diagram diagram = builder.build();
  Machine machine(compile(diagram));
  machine.load(diagram.create_context());
  machine.evaluate_instant(0.0);
  SeenGuards seen(machine);
  REQUIRE(machine.plan().controls.size() == 1);
  double& control = *machine.signal(machine.plan().controls.front());

  for (const double value : {0.0, 1.0, 0.0}) {
    INFO(value);
    control = value;
    CHECK(chosen(seen) == (value != 0.0 ? std::vector{0, 1} : std::vector<int>{}));
    CHECK_FALSE(seen.outdated());
    control = 1.0 - value;
    CHECK(seen.outdated());
  }
}
