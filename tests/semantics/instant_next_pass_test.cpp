// Semantics 3.4: what a commit moved across zero fires in the next pass.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A held number that becomes 1 at 1 s.
void declare_switch(Leaf& l) {
  l.declare_discrete_state(vec({0.0}));
  l.declare_discrete_state_output("out");
  l.declare_one_shot(1.0, count_up, "on");
}

}  // namespace

TEST_CASE("3.4 an edge that a commit moved resets an Integrator at the same t, one j later",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool opaque = GENERATE(false, true);
  INFO("method " << method << ", opaque " << opaque);
  DiagramBuilder builder;
  auto& source = builder.add<Leaf>("source", declare_switch);
  auto& half = builder.add<Constant>("half", 0.5);
  auto& one = builder.add<Constant>("one", 1.0);
  auto& x = builder.add<Integrator>("x", Integrator::Options{.enable_reset = true});
  OutputPort on;
  if (opaque) {
    auto& above = builder.add<FunctionBlock>("above", [](double u) { return u > 0.5; });
    builder.connect(source.output(), above.input()), on = above.output();
  } else {
    auto& above = builder.add<Comparator>("above", ">");
    builder.connect(source.output(), above.input(0)),
        builder.connect(half.output(), above.input(1));
    on = above.output();
  }
  builder.connect(one.output(), x.input("in")), builder.connect(on, x.input("reset_trigger"));
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 1.5}, {.ode_solver_method = method});
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.5, 1e-9));
  const auto resets = results.events.times("x.reset");
  CHECK(resets == std::vector{1.0});
  CHECK(results.events[0].jump == 1);
  CHECK(results.events[results.events.size() - 1].jump == 2);
}

TEST_CASE("3.4 a guard that the commit moved against its direction does not fire", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool rising = GENERATE(true, false);
  INFO("method " << method << ", rising " << rising);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 0.0, -1.0);
    l.declare_discrete_state(vec({0.0}));
    l.declare_one_shot(1.0, [](const At&, Next& next) { next.set_continuous_state({1.0}); });
    l.declare_zero_crossing({.name = "moved",
                             .guard = [](const At& at) { return at.x[0]; },
                             .reset_map = count_up,
                             .direction = rising ? Direction::negative_then_non_negative
                                                 : Direction::positive_then_non_positive});
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  CHECK(results.events.times("moved") == (rising ? std::vector{1.0} : std::vector<double>{}));
  CHECK(results.context.discrete_state()[0] == (rising ? 1.0 : 0.0));
}

TEST_CASE("3.4 a loop ends after max_passes, 100, with the chain of causes by block path",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder inner, outer;
  inner.add<Leaf>("leaf", [](Leaf& l) {
    l.declare_discrete_state(vec({1.0, 1.0}));
    l.declare_one_shot(
        1.0, [](const At& at, Next& next) { next.set_discrete_state({-1.0, at.z[1]}); }, "kick");
    for (const Index i : {0, 1}) {  // each turns the sign that the other one watches
      l.declare_zero_crossing({.name = i == 0 ? "first" : "second",
                               .guard = [=](const At& at) { return at.z[i]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     Eigen::VectorXd z = at.z;
                                     z[1 - i] = -z[1 - i];
                                     next.set_discrete_state(z);
                                   }});
    }
  });
  outer.add(std::make_shared<Diagram>(inner.build("inner")));
  const Diagram diagram = outer.build("outer");
  const std::string what = message<SimulationError>([&] {
    simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  });
  INFO(what);
  CHECK(SimulatorOptions{}.max_passes == 100);
  CHECK(contains(what, "more than 100 passes"));
  CHECK(contains(what, "'inner.leaf.first' -> 'inner.leaf.second'"));
}
