// Semantics 1: what a context holds, and hybrid time (t, j).
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = 1 with everything that counts as a pass, and a monitor, which does not.
Leaf busy() {
  return Leaf("busy", [](Leaf& l) {
    declare_ramp(l);
    l.declare_default_mode(4);
    l.declare_discrete_state(vec({0.0}));
    l.declare_dynamic_parameter("p", vec({2.0, 3.0}));
    const auto at_level = [](double level) {
      return [=](const At& at) { return at.x[0] - level; };
    };
    l.declare_zero_crossing({.name = "monitor", .guard = at_level(0.125)});
    l.declare_zero_crossing({.name = "reset", .guard = at_level(0.25), .reset_map = count_up});
    l.declare_periodic_update(count_up, 10.0, 0.5, "update");
    l.declare_zero_crossing(
        {.name = "change", .guard = at_level(0.75), .start_mode = 4, .end_mode = 5});
  });
}

}  // namespace

TEST_CASE("1.1 a context holds time, continuous and discrete state, a mode per leaf, parameters",
          "[semantics]") {
  DiagramBuilder builder;
  builder.add(std::make_shared<Leaf>(busy()));
  builder.add<Leaf>("second", [](Leaf& l) { declare_ramp(l, 1.0, 7.0); });
  const Diagram diagram = builder.build();
  const Context context = diagram.create_context(1.5);
  CHECK(context.time() == 1.5);
  CHECK(context.continuous_state() == vec({0.0, 7.0}));
  CHECK(context.discrete_state() == vec({0.0}));
  CHECK(context.modes() == std::vector{4, 0});
  CHECK(context.parameters() == vec({2.0, 3.0}));
}

TEST_CASE("1.1 a run changes neither the context it started from nor the system", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf = busy();
  const Context before = leaf.create_context().with_parameter("p", vec({5.0, 6.0}));
  const Context kept = before;
  const auto results = simulate(leaf, before, {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(same_bits(before, kept));
  CHECK(results.context.mode() == 5);
  CHECK(same_bits(leaf.create_context().with_parameter("p", vec({5.0, 6.0})), kept));
}

TEST_CASE("1.2 j counts passes with a reset, an update or a mode change, and no monitors",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = busy();
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0},
               {.ode_solver_method = method, .recorded_signals = {{"x", leaf.output()}}});
  REQUIRE(results.events.size() == 4);
  const std::vector<std::string> names{"monitor", "reset", "update", "change"};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(results.events[i].name == names[i]);
    CHECK(results.events[i].jump == static_cast<int>(i));
  }
  CHECK(results.jump.front() == 0);
  CHECK(results.jump.back() == 3);
  CHECK(std::ranges::is_sorted(results.jump));
}
