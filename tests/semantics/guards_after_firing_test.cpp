// Semantics 2.5: when a guard that has fired fires again.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A ball whose reset only turns the velocity: what location left below the floor stays there.
Leaf turning_ball(double e) {
  return Leaf("ball", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -9.81; }});
    l.declare_continuous_state_output("state");
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0]; },
         .reset_map = [=](const At& at,
                          Next& next) { next.set_continuous_state({at.x[0], -e * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

}  // namespace

TEST_CASE("2.5 a guard that was merely passed through fires once, whatever its reset writes",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const bool writes_state = GENERATE(true, false);
  INFO("method " << method << ", reset writes continuous state: " << writes_state);
  std::vector<double> roots;
  for (int i = 1; i <= 50; ++i) roots.push_back(std::fmod(0.6180339887498949 * i, 1.0));
  const Leaf leaf("leaf", [&](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    for (const double root : roots) {
      l.declare_zero_crossing({.guard = [=](const At& at) { return 3.0 * at.x[0] - 3.0 * root; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     count_up(at, next);
                                     if (writes_state) next.set_continuous_state(at.x);
                                   }});
    }
  });
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(results.events.size() == roots.size());
  CHECK(results.context.discrete_state()[0] == 50.0);
}

TEST_CASE("2.5 a guard whose mode is entered at its zero waits until it has been off zero",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // Both guards stand at sin t = 0; the first one hands on to the second at pi.
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << -at.x[1], at.x[0]; }});
    l.declare_default_mode(0);
    const auto sine = [](const At& at) { return at.x[1]; };
    l.declare_zero_crossing({.name = "first",
                             .guard = sine,
                             .direction = Direction::positive_then_non_positive,
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "second", .guard = sine, .start_mode = 1, .end_mode = 2});
  });
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 7.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  REQUIRE(results.events.size() == 2);
  const double pi = std::acos(-1.0);
  CHECK_THAT(results.events[0].time, WithinAbs(pi, 1e-6));
  CHECK_THAT(results.events[1].time, WithinAbs(2.0 * pi, 1e-6));
}

TEST_CASE("2.5 a reset that turns the flow round re-arms a guard that rounding left beyond zero",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(1.0, 0.9, 0.5, 0.1, 0.0);
  const double rtol = GENERATE(1e-2, 1e-6, 1e-10);
  INFO("method " << method << ", e " << e << ", rtol " << rtol);
  const Leaf ball = turning_ball(e);
  const auto results = simulate(ball, ball.create_context(), {0.0, 20.0},
                                {.rtol = rtol,
                                 .atol = 1e-2 * rtol,
                                 .ode_solver_method = method,
                                 .recorded_signals = {{"state", ball.output()}}});
  // Location leaves it 100 eps (t + h) v <= 4e-12 m low; the prediction of the accumulation state
  // multiplies that by at most 1 / (1 - q) = 10. Rows below that are rows of a fall.
  for (const double y : column(results, "state")) REQUIRE(y > -1e-10);
}

TEST_CASE("2.5 a swing that turns at zero by its reset goes on swinging, in every direction",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const auto direction = GENERATE(Direction::crosses_zero, Direction::positive_then_non_positive,
                                  Direction::negative_then_non_negative);
  const bool keeps_x = GENERATE(true, false);  // what location left of it, or exactly zero
  INFO("method " << method << ", " << to_string(direction) << ", keeps x " << keeps_x);
  const double sign = direction == Direction::negative_then_non_negative ? -1.0 : 1.0;
  const Leaf swing("swing", [=](Leaf& leaf) {  // x = +-cos t, turned and halved at each zero
    leaf.declare_continuous_state(
        {.initial = vec({sign, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    leaf.declare_zero_crossing({.name = "axis",
                                .guard = [](const At& at) { return at.x[0]; },
                                .reset_map =
                                    [=](const At& at, Next& next) {
                                      next.set_continuous_state(
                                          {keeps_x ? at.x[0] : 0.0, -0.5 * at.x[1]});
                                    },
                                .direction = direction});
  });
  const auto results = simulate(swing, swing.create_context(), {0.0, 12.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(results.events.times("axis").size() == 4);  // pi / 2 + k pi
  CHECK_THAT(results.context.continuous_state()[0],
             WithinAbs(sign * std::abs(std::cos(12.0)) / 16.0, 1e-6));
}

TEST_CASE("2.5 a guard that a later pass carries across zero fires again at the same instant",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // x runs to 1 and is put to 0; the other block answers by putting it to 2, once.
  DiagramBuilder builder;
  auto& runner = builder.add<Leaf>("runner", [](Leaf& l) {
    l.declare_input_port({.name = "start", .shape = Shape::scalar()});
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("rounds");
    l.declare_zero_crossing({.name = "full",
                             .guard = [](const At& at) { return at.x[0] + at.u(0) - 1.0; },
                             .reset_map =
                                 [](const At& at, Next& next) {
                                   next.set_continuous_state({-at.u(0)});
                                   count_up(at, next);
                                 },
                             .direction = Direction::negative_then_non_negative});
  });
  auto& answer = builder.add<Leaf>("answer", [](Leaf& l) {
    l.declare_input_port({.name = "rounds", .shape = Shape::scalar()});
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("push");
    l.declare_zero_crossing(
        {.name = "push",
         .guard = [](const At& at) { return at.u(0) - 0.5; },
         .reset_map = [](const At&, Next& next) { next.set_discrete_state({2.0}); },
         .direction = Direction::negative_then_non_negative});
  });
  builder.connect(answer.output(), runner.input());
  builder.connect(runner.output("rounds"), answer.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 1.5}, {.ode_solver_method = method});
  CHECK(events(results.events) == std::vector<std::string>{"zero_crossing runner.full",
                                                           "zero_crossing answer.push",
                                                           "zero_crossing runner.full"});
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    CHECK(results.events[i].time == results.events[0].time);
    CHECK(results.events[i].jump == static_cast<int>(i) + 1);
  }
}
