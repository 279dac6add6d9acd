// Events that go on without time advancing end the run: status chattering, who did it, and what
// helps.

#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// x' = -sign(x) by two modes, started off the switching surface.
Leaf sliding_modes() {
  return Leaf("relay", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({0.5}), .ode = [](const At& at) { return at.mode == 1 ? -1.0 : 1.0; }});
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "down",
                             .guard = [](const At& at) { return at.x[0]; },
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 1,
                             .end_mode = -1});
    l.declare_zero_crossing({.name = "up",
                             .guard = [](const At& at) { return at.x[0]; },
                             .direction = Direction::negative_then_non_negative,
                             .start_mode = -1,
                             .end_mode = 1});
  });
}

/// The same by a relation.
Leaf sliding_relation() {
  return Leaf("relay", [](Leaf& l) {
    const auto positive =
        l.declare_relation({.name = "positive", .guard = [](const At& at) { return at.x[0]; }});
    l.declare_continuous_state({.initial = vec({0.5}), .ode = [=](const At& at) {
                                  return at.relation(positive) ? -1.0 : 1.0;
                                }});
  });
}

void chatters(const System& system, Method method, const std::string& block) {
  const auto results = simulate(system, system.create_context(), {0.0, 10.0},
                                {.ode_solver_method = method, .throw_errors = false});
  INFO(to_string(results.status) << ": " << results.message
                                 << ", x = " << results.context.continuous_state());
  CHECK(results.status == Status::chattering);
  CHECK(contains(results.message, text("block '", block, "' fired")));
  CHECK(contains(results.message, "hysteresis"));
  CHECK(contains(results.message, "zeno_tolerance"));
  CHECK(std::abs(results.context.time() - 0.5) < 1e-3);
  CHECK(std::abs(results.context.continuous_state()[0]) < 1e-6);
  CHECK(results.events.size() < 10000);
}

}  // namespace

TEST_CASE("sliding along a switching surface by modes chatters", "[errors][chattering]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  chatters(sliding_modes(), method, "relay");
}

TEST_CASE("sliding along a switching surface by a relation chatters", "[errors][chattering]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  chatters(sliding_relation(), method, "relay");
}

TEST_CASE("sliding in a diagram with a Comparator or a lambda chatters", "[errors][chattering]") {
  const auto method = GENERATE(from_range(methods));
  const bool opaque = GENERATE(true, false);
  INFO("method " << method << ", opaque " << opaque);
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 0.5});
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& minus = builder.add<Constant>("minus", -1.0);
  auto& plus = builder.add<Constant>("plus", 1.0);
  auto& choice = builder.add<Switch>("choice");
  if (opaque) {
    auto& above = builder.add<FunctionBlock>("above", [](double value) { return value > 0.0; });
    builder.connect(x.output(), above.input()),
        builder.connect(above.output(), choice.input("control"));
  } else {
    auto& above = builder.add<Comparator>("above", ">");
    builder.connect(x.output(), above.input(0)), builder.connect(zero.output(), above.input(1));
    builder.connect(above.output(), choice.input("control"));
  }
  builder.connect(minus.output(), choice.input("true_value")),
      builder.connect(plus.output(), choice.input("false_value"));
  builder.connect(choice.output(), x.input());
  chatters(builder.build(), method, "above");
}

TEST_CASE("a ball without Zeno monitor past its Zeno time chatters", "[errors][chattering]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.3, 0.9);
  for (const BallScene& scene : all_forms({.e = e})) {
    INFO(scene.form << ", method " << method << ", e = " << e);
    const auto results =
        simulate(*scene.system, scene.context(0.1, 0.0), {0.0, 10.0},
                 {.ode_solver_method = method, .zeno_tolerance = 0.0, .throw_errors = false});
    INFO(to_string(results.status) << ": " << results.message);
    CHECK(results.status == Status::chattering);
    CHECK(contains(results.message, "zeno_tolerance"));
    CHECK(std::abs(results.context.continuous_state()[0]) < 1e-6);  // it did not fall through
    CHECK(results.events.size() < 10000);
  }
}

TEST_CASE("a sliding run that starts on its surface at t = 0 does not hang",
          "[errors][chattering]") {
  const auto method = GENERATE(from_range(methods));
  const bool modes = GENERATE(true, false);
  INFO("method " << method << ", modes " << modes);
  const Leaf leaf = modes ? sliding_modes() : sliding_relation();
  const auto results = simulate(leaf, leaf.create_context().with_continuous_state(vec({0.0})),
                                {0.0, 1.0}, {.ode_solver_method = method, .throw_errors = false});
  INFO(to_string(results.status) << ": " << results.message
                                 << ", x = " << results.context.continuous_state());
  CHECK(results.status != Status::reached_end);
  CHECK(results.events.size() < 10000);
}
