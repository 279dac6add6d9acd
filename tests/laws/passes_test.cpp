// Passes of an instant: chains of resets across blocks, loops, values swapped at a tick, order
// within a leaf.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// A held value in discrete state 0 that becomes `value` when input 0 rises through 0.5; output:
/// the value.
std::shared_ptr<Leaf> link(std::string name, double value) {
  return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
    l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("out");
    l.declare_zero_crossing(
        {.name = "follow",
         .guard = [](const At& at) { return at.u(0) - 0.5; },
         .reset_map = [=](const At&, Next& next) { next.set_discrete_state({value}); },
         .direction = Direction::negative_then_non_negative});
  });
}

/// x' = 1; at x = 1 its discrete state becomes 1.
std::shared_ptr<Leaf> starter() {
  return std::make_shared<Leaf>("starter", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("out");
    l.declare_zero_crossing(
        {.name = "go",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_discrete_state({1.0}); }});
  });
}

}  // namespace

TEST_CASE("a reset that moves the guard of another block across zero fires it in the next pass",
          "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  const auto first = starter();
  builder.add(first);
  std::shared_ptr<const System> before = first;
  OutputPort from = first->output("out");
  for (int i = 0; i < 4; ++i) {
    const auto next = link(text("link_", i), 1.0);
    builder.add(next);
    builder.connect(from, next->input());
    from = next->output();
  }
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 2.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(results.events[i].time == results.events[0].time);
    CHECK(results.events[i].jump == static_cast<int>(i) + 1);
    CHECK(results.events[i].block == (i == 0 ? std::string("starter") : text("link_", i - 1)));
  }
  CHECK(results.context.discrete_state() == Eigen::VectorXd::Ones(5));
}

TEST_CASE("a loop of resets is an error that prints the chain of causes", "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // b follows a, a turns against b: whenever one has moved the other has to.
  const auto flip = [](std::string name, double sign) {
    return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
      l.declare_input_port({.name = "in", .shape = Shape::scalar()});
      l.declare_discrete_state(vec({-1.0}));
      l.declare_discrete_state_output("out");
      l.declare_zero_crossing(
          {.name = "turn",
           .guard = [](const At& at) { return at.u(0); },
           .reset_map = [=](const At& at,
                            Next& next) { next.set_discrete_state({sign * at.u(0)}); }});
    });
  };
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& start = builder.add<Leaf>("start", [](Leaf& l) {
    l.declare_input_port({.name = "time", .shape = Shape::scalar()});
    l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    l.declare_discrete_state(vec({-1.0}));
    l.declare_discrete_state_output("out");
    l.declare_zero_crossing(
        {.name = "kick",
         .guard = [](const At& at) { return at.u(0) - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_discrete_state({1.0}); }});
    l.declare_zero_crossing(
        {.name = "back",
         .guard = [](const At& at) { return at.u(1); },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({-at.u(1)}); }});
  });
  const auto follow = flip("follow", 1.0);
  builder.add(follow);
  builder.connect(clock.output(), start.input(0));
  builder.connect(follow->output(), start.input(1));
  builder.connect(start.output(), follow->input());
  const Diagram diagram = builder.build();
  const std::string what = message<SimulationError>([&] {
    simulate(diagram, diagram.create_context(), {0.0, 2.0},
             {.ode_solver_method = method, .max_passes = 20});
  });
  INFO(what);
  CHECK(contains(what, "t = 1"));
  CHECK(contains(what, "more than 20 passes"));
  CHECK(contains(what, "'start.back' -> 'follow.turn'"));
  CHECK(contains(what, "max_passes"));
}

TEST_CASE("two guards at one surface that throw the state to each other end in that error",
          "[laws][passes]") {
  // The one resets to 0 where x rises to 0.5, the other to 1 where x falls to 0.5: from 0.5 on each
  // reset fires the other.
  const auto method = GENERATE(from_range(methods));
  const double begin = GENERATE(0.0, 0.1, -0.25);
  INFO("method " << method << ", from " << begin);
  const Leaf leaf("leaf", [=](Leaf& l) {
    declare_ramp(l, 1.0, begin);
    const auto resets_to = [](double x) {
      return [x](const At&, Next& next) { next.set_continuous_state({x}); };
    };
    l.declare_zero_crossing({.name = "down",
                             .guard = [](const At& at) { return at.x[0] - 0.5; },
                             .reset_map = resets_to(0.0),
                             .direction = Direction::negative_then_non_negative});
    l.declare_zero_crossing({.name = "up",
                             .guard = [](const At& at) { return 0.5 - at.x[0]; },
                             .reset_map = resets_to(1.0),
                             .direction = Direction::negative_then_non_negative});
  });
  double ended = not_a_number;
  const std::string what = message<SimulationError>([&] {
    try {
      simulate(leaf, leaf.create_context(), {0.0, 4.0}, {.ode_solver_method = method});
    } catch (const SimulationError& error) {
      ended = error.time();
      throw;
    }
  });
  INFO(what);
  CHECK(contains(what, "more than 100 passes"));
  CHECK_THAT(ended, WithinAbs(0.5 - begin, 1e-12));
}

TEST_CASE("two blocks swap values at a tick", "[laws][passes]") {
  const auto holder = [](std::string name, double value) {
    return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
      l.declare_input_port({.name = "in", .shape = Shape::scalar()});
      l.declare_discrete_state(vec({value}));
      l.declare_discrete_state_output("out");
      l.declare_periodic_update(
          [](const At& at, Next& next) { next.set_discrete_state({at.u(0)}); }, 1.0, 1.0);
    });
  };
  DiagramBuilder builder;
  const auto a = holder("a", 1.0), b = holder("b", 2.0);
  builder.add(a), builder.add(b);
  builder.connect(a->output(), b->input()), builder.connect(b->output(), a->input());
  const Diagram diagram = builder.build();
  const auto after = [&](double t) {
    return simulate(diagram, diagram.create_context(), {0.0, t}).context.discrete_state();
  };
  CHECK(after(0.5) == vec({1.0, 2.0}));
  CHECK(after(1.5) == vec({2.0, 1.0}));
  CHECK(after(2.5) == vec({1.0, 2.0}));
}

TEST_CASE(
    "within a leaf resets run in declaration order and see each other; across leaves none sees "
    "another's",
    "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf one("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_discrete_state(vec({1.0}));
    const auto guard = [](const At& at) { return at.x[0] - 0.5; };
    l.declare_zero_crossing(
        {.name = "add", .guard = guard, .reset_map = [](const At& at, Next& next) {
           next.set_discrete_state({at.z[0] + 10.0});
         }});
    l.declare_zero_crossing(
        {.name = "double", .guard = guard, .reset_map = [](const At& at, Next& next) {
           next.set_discrete_state({at.z[0] * 2.0});
         }});
  });
  const auto in_leaf =
      simulate(one, one.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(in_leaf.context.discrete_state()[0] == 22.0);
  CHECK(in_leaf.events[0].jump == 1);
  CHECK(in_leaf.events[1].jump == 1);

  const auto reader = [](std::string name, double value) {
    return std::make_shared<Leaf>(std::move(name), [=](Leaf& l) {
      declare_ramp(l);
      l.declare_input_port({.name = "in", .shape = Shape::scalar()});
      l.declare_discrete_state(vec({value}));
      l.declare_discrete_state_output("z");
      l.declare_zero_crossing(
          {.name = "take",
           .guard = [](const At& at) { return at.x[0] - 0.5; },
           .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.u(0)}); }});
    });
  };
  DiagramBuilder builder;
  const auto a = reader("a", 1.0), b = reader("b", 2.0);
  builder.add(a), builder.add(b);
  builder.connect(a->output("z"), b->input()), builder.connect(b->output("z"), a->input());
  const Diagram diagram = builder.build();
  const auto across =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  CHECK(across.context.discrete_state() == vec({2.0, 1.0}));
}

TEST_CASE("a reset by time and one by state: the sawtooth of both", "[laws][passes]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf("leaf", [](Leaf& l) {
    declare_ramp(l);
    l.declare_one_shot(0.5, [](const At&, Next& next) { next.set_continuous_state({0.0}); });
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 1.5; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  const auto at = [&](double t) {
    return simulate(leaf, leaf.create_context(), {0.0, t}, {.ode_solver_method = method})
        .context.continuous_state()[0];
  };
  CHECK_THAT(at(1.0), WithinAbs(0.5, 1e-9));
  CHECK_THAT(at(2.5), WithinAbs(0.5, 1e-9));
}
