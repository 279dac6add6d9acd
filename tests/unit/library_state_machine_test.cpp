// State machines: when transitions are taken, the order of actions, and chains in one instant.
#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

using Now = StateMachineValues;
using Action = StateMachineAction;
using Condition = StateMachineCondition;
using Wire = std::function<void(DiagramBuilder&, StateMachine&)>;
using Vector = std::vector<double>;

constexpr double pi = 3.14159265358979323846;

const auto sine = fed_by<Sine>();
const auto pulse = [](double period, double width = 0.5, double delay = 0.0) {
  return fed_by<Pulse>(PulseOptions{.period = period, .pulse_width = width, .phase_delay = delay});
};
const auto above = [](double level) {
  return [=](const Now& now) { return now.inputs(0) > level; };
};
const auto beyond = [](double level) {  // the same as a number, which is located smoothly
  return [=](const Now& now) { return now.inputs(0) - level; };
};
const auto below = [](double level) {
  return [=](const Now& now) { return now.inputs(0) < level; };
};
const auto always = [](const Now&) { return true; };

Action append(double digit) {
  return [=](const Now& now, VectorRef log) { log[0] = 10.0 * now.variables[0] + digit; };
}

const auto without_input = [](DiagramBuilder&, auto&) {};

std::string refusal(const StateMachineOptions& options) {
  try {
    StateMachine("machine", options);
  } catch (const BlockParameterError& error) {
    return error.what();
  }
  return "it was not refused";
}

}  // namespace

TEST_CASE("guards and times of a state machine are those of the closed form") {
  // sin t > 1/2 at pi / 6, sin t < -1/2 at 7 pi / 6. The motor runs 1/4 s after each, so its
  // integral rises to 1/4 and falls back to 0.
  const StateMachineOptions lift{
      .states = {"down", "rising", "up", "falling"},
      .transitions = {{"down", "rising", above(0.5)},
                      {.source = "rising", .target = "up", .after = 0.25},
                      {"up", "falling", below(-0.5)},
                      {.source = "falling", .target = "down", .after = 0.25}},
      .inputs = {"u"},
      .variables = {{"rides", 0.0}},
      .exit = {{"rising", [](const Now&, VectorRef rides) { rides[0] += 1.0; }}},
      .outputs = {{.name = "motor", .levels = {{"rising", 1.0}, {"falling", -1.0}}}}};
  for (const Method method : {Method::dopri5, Method::dop853, Method::radau, Method::bdf,
                              Method::adams, Method::automatic}) {
    const BlockRun<StateMachine> run(
        [](DiagramBuilder& builder, StateMachine& machine) {
          sine(builder, machine);
          builder.connect(machine.output(2), builder.add<Integrator>("height").input());
        },
        lift);
    SimulatorOptions options = precise();
    options.ode_solver_method = method;
    const Results results = run.run(6.0, options);
    // located on a signal that is computed exactly, within 100 eps (t + h)
    CHECK_THAT(results.events.times("block.down_to_rising").at(0), WithinAbs(pi / 6.0, 2e-13));
    CHECK_THAT(results.events.times("block.up_to_falling").at(0), WithinAbs(7.0 * pi / 6.0, 2e-13));
    CHECK_THAT(results.events.times("block.rising_to_up").at(0), WithinAbs(pi / 6.0 + 0.25, 4e-13));
    CHECK_THAT(results.context.continuous_state()[0], WithinAbs(0.0, 1e-12));
    CHECK(results.context.discrete_state()[1] == 1.0);
  }
}

TEST_CASE("the actions of a state machine run in their order, and that of the start once") {
  const BlockRun<StateMachine> run(
      without_input,
      StateMachineOptions{
          .states = {"a", "b"},
          .transitions = {{.source = "a", .target = "b", .after = 1.0, .action = append(3.0)}},
          .variables = {{"log", 0.0}},
          .entry = {{"a", append(1.0)}, {"b", append(4.0)}},
          .exit = {{"a", append(2.0)}, {"b", append(9.0)}}});
  const Results first = run.run(3.0);
  CHECK(first.context.discrete_state()[1] == 1234.0);
  CHECK(first.events.times("block.start") == Vector{0.0});
  const Results second = simulate(run.diagram, first.context, {3.0, 4.0}, precise());
  CHECK(second.events.size() == 0);
  CHECK(second.context.discrete_state()[1] == 1234.0);
}

TEST_CASE("a chain of transitions at one time goes on until it ends, or is an error") {
  const Action count = [](const Now&, VectorRef n) { n[0] += 1.0; };
  const auto fewer = [](const Now& now) { return now.variables[0] < 3.0 && now.inputs(0) > 0.5; };
  const auto fewer_as_number = [](const Now& now) {
    return std::min(2.5 - now.variables[0], now.inputs(0) - 0.5);
  };
  // a jump, and a slope whose crossing is located within rounding
  for (const auto& source :
       {Wire(fed_by<Step>(StepOptions{.step_time = 0.5})), Wire(fed_by<Clock>())}) {
    for (const Condition& first : {Condition(fewer), Condition(fewer_as_number)}) {
      const BlockRun<StateMachine> ends(
          source,
          StateMachineOptions{
              .states = {"a", "b"},
              .transitions = {{"a", "b", first},
                              {.source = "b", .target = "a", .guard = always, .action = count}},
              .inputs = {"u"},
              .variables = {{"n", 0.0}}});
      const Vector found = ends.run(2.0).events.times("block.b_to_a");
      REQUIRE(found.size() == 3);
      CHECK_THAT(found[0], WithinAbs(0.5, 1e-12));
      CHECK(found[2] == found[0]);
    }
    for (const auto& [up, back] : {std::pair<Condition, Condition>(above(0.5), above(0.25)),
                                   std::pair<Condition, Condition>(beyond(0.5), beyond(0.25))}) {
      const BlockRun<StateMachine> loops(
          source, StateMachineOptions{.states = {"a", "b"},
                                      .transitions = {{"a", "b", up}, {"b", "a", back}},
                                      .inputs = {"u"}});
      CHECK_THROWS_WITH(loops.run(2.0), Contains("'block.a_to_b' -> 'block.b_to_a'"));
    }
  }
}

TEST_CASE("of the transitions that could be taken at one time one is taken, by priority") {
  struct Row {
    double b, c;
    double expected;
  };
  const std::vector<Wire> sources{fed_by<Step>(StepOptions{.step_time = 1.0}), fed_by<Clock>()};
  const auto taken = [](const Now&, VectorRef n) { n[0] += 1.0; };
  for (const Row& row : {Row{0, 0, 1}, Row{0, 1, 2}, Row{2, 1, 1}}) {
    for (const auto& source : sources) {
      for (const Condition& both : {Condition(above(0.5)), Condition(beyond(0.5))}) {
        for (const bool by_trigger : {false, true}) {
          StateMachineTransition b{"a", "b"}, c{"a", "c"};
          b.priority = row.b;
          c.priority = row.c;
          for (auto* each : {&b, &c}) (by_trigger ? each->trigger : each->guard) = both;
          const BlockRun<StateMachine> run(source, StateMachineOptions{.states = {"a", "b", "c"},
                                                                       .transitions = {b, c},
                                                                       .inputs = {"u"},
                                                                       .variables = {{"taken", 0}},
                                                                       .exit = {{"a", taken}}});
          const Results results = run.run(2.0);
          CHECK(run.at({2.0}) == Vector{row.expected});
          CHECK(results.context.discrete_state()[1] == 1.0);
        }
      }
    }
  }
}

TEST_CASE(
    "priorities decide between a trigger that a tick moves and a time that ends at that tick") {
  // The trigger rises at 1 s, and the time in the state ends there.
  const std::vector<Wire> sources{pulse(4.0, 0.5, 1.0), fed_by<Step>(StepOptions{.step_time = 1.0}),
                                  [](DiagramBuilder& builder, StateMachine& machine) {
                                    auto& clock = builder.add<Clock>("clock");
                                    auto& held = builder.add<ZeroOrderHold>("held", 1.0);
                                    builder.connect(clock.output(), held.input());
                                    builder.connect(held.output(), machine.input());
                                  }};
  struct Row {
    const char* what;
    double trigger, time;  // priorities
    bool trigger_returns, time_returns;
    double log;
  };
  const std::vector<Row> rows{{"trigger first", 1, 0, false, false, 1.0},
                              {"time first", 0, 1, false, false, 2.0},
                              {"a trigger that returns", 1, 0, true, false, 1.0},
                              {"a time behind a trigger that leaves", 1, 0, false, true, 1.0},
                              {"a time that returns", 0, 1, false, true, 2.0},
                              {"both return, trigger first", 1, 0, true, true, 1.0},
                              {"both return, time first", 0, 1, true, true, 2.0}};
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < sources.size(); ++k) {
      for (const bool guarded : {false, true}) {
        INFO(row.what << ", source " << k << ", guarded " << guarded);
        StateMachineTransition trigger{"a", row.trigger_returns ? "a" : "b"},
            time{.source = "a", .target = row.time_returns ? "a" : "c"};
        trigger.trigger = above(0.5), trigger.priority = row.trigger, trigger.action = append(1.0);
        time.priority = row.time, time.action = append(2.0);
        if (guarded)
          time.guard = [](const Now& now) { return now.since - 1.0; };
        else
          time.after = 1.0;
        const BlockRun<StateMachine> scene(nth(sources, k),
                                           StateMachineOptions{.states = {"a", "b", "c"},
                                                               .transitions = {time, trigger},
                                                               .inputs = {"u"},
                                                               .variables = {{"log", 0.0}}});
        CHECK(scene.at({1.5}, 1)[0] == row.log);
      }
    }
  }
}

TEST_CASE("of several transitions of a state to itself that are due at one time one is taken") {
  // The pulse rises at 1/2, 3/2 and 5/2 s. Each transition from "on" appends its digit to the log.
  struct Row {
    const char* what;
    StateMachineTransition first, second;
    double log;
  };
  const auto log_beyond = [](double level) {
    return [=](const Now& now) { return now.variables[0] > level; };
  };
  const Condition rises = above(0.5);
  const StateMachineTransition again{"on", "on", {}, rises}, away{"on", "off", {}, rises};
  const StateMachineTransition soon{.source = "on", .target = "on", .after = 0.75};
  const std::vector<Row> rows{
      {"two triggers", again, again, 111.0},
      {"by priority",
       again,
       {.source = "on", .target = "on", .trigger = rises, .priority = 1.0},
       222.0},
      {"two times", soon, soon, 111.0},
      {"a longer time never comes", soon, {.source = "on", .target = "on", .after = 1.0}, 111.0},
      {"the guard of the first is false", {"on", "on", log_beyond(1e9), rises}, again, 222.0},
      {"away, where the first returns", again, away, 111.0},
      {"a guard that the first makes true is taken at once",
       again,
       {"on", "off", log_beyond(10.0)},
       112.0},
      {"a guard that the first makes false is not taken",
       again,
       {"on", "off", [](const Now& now) { return now.variables[0] < 1.0 && now.inputs(0) > 0.5; }},
       111.0}};
  for (const Row& row : rows) {
    INFO(row.what);
    StateMachineOptions options{
        .states = {"on", "off"}, .inputs = {"u"}, .variables = {{"log", 0.0}}};
    double digit = 1.0;
    for (StateMachineTransition each : {row.first, row.second}) {
      each.name = text("t", digit);
      each.action = append(digit++);
      options.transitions.push_back(each);
    }
    const BlockRun<StateMachine> scene(pulse(1.0, 0.5, 0.5), options);
    CHECK(scene.at({2.75}, 1)[0] == row.log);
  }
}

TEST_CASE("a trigger moves a state machine on by one state each time") {
  const StateMachineOptions two{
      .states = {"a", "b", "c"},
      .transitions = {{.source = "a", .target = "b", .trigger = above(0.5)},
                      {.source = "b", .target = "c", .trigger = above(0.5)}},
      .inputs = {"u"}};
  // true at 0 to 1, 2 to 3, 4 to 5: a trigger that is true at the start is none
  CHECK(BlockRun<StateMachine>(pulse(2.0), two).at({0.5, 2.5, 3.5, 4.5}) == Vector{0, 1, 1, 2});
  StateMachineOptions smooth = two;
  smooth.transitions = {{.source = "a", .target = "b", .trigger = beyond(0.5)},
                        {.source = "b", .target = "c", .trigger = beyond(0.5)}};
  // sin(pi t) is above 1/2 from 1/6, 13/6, ...
  const auto waves = fed_by<Sine>(SineOptions{.frequency = pi});
  CHECK(BlockRun<StateMachine>(waves, smooth).at({0.1, 0.2, 2.1, 2.2}) == Vector{0, 1, 1, 2});
}

TEST_CASE("a guard beside a trigger decides at its edge") {
  const auto late = [](const Now& now) { return now.time > 3.0; };
  const StateMachineOptions options{
      .states = {"a", "b"},
      .transitions = {{.source = "a", .target = "b", .guard = late, .trigger = above(0.5)}},
      .inputs = {"u"}};
  CHECK(BlockRun<StateMachine>(pulse(2.0), options).at({2.5, 3.5, 4.5}) == Vector{0, 0, 1});
}

TEST_CASE("the time in a state counts from each entry, also of the same state") {
  // without a call the door closes after 1 s; the call is true from 0.5 to 2.5
  const StateMachineOptions door{
      .states = {"open", "shut"},
      .transitions = {{.source = "open", .target = "open", .trigger = above(0.5)},
                      {.source = "open", .target = "shut", .guard = below(0.5), .after = 1.0}},
      .inputs = {"u"},
      .outputs = {{.name = "age", .function = [](const Now& now) { return now.since; }}}};
  const BlockRun<StateMachine> run(pulse(10.0, 0.2, 0.5), door);
  const Vector times{0.4, 1.6, 2.4, 2.6}, ages{0.4, 1.1, 1.9, 0.1};
  CHECK(run.at(times) == Vector{0, 0, 0, 1});
  for (std::size_t k = 0; k < times.size(); ++k)
    CHECK_THAT(run.at(times, 1)[k], WithinAbs(ages[k], 1e-12));
}

TEST_CASE("parameters of a state machine belong to the context, and it may start in any state") {
  const StateMachineOptions options{
      .states = {"b", "a"},
      .transitions = {{.source = "a",
                       .target = "b",
                       .guard = [](const Now& now) { return now.time - now.parameters[0]; }}},
      .parameters = {{"level", 1.0}},
      .initial = "a"};
  StateMachine made("machine", options);
  const StateMachine machine = std::move(made);  // its functions do not refer to the old place
  const Context context = machine.create_context().with_parameter("level", 2.0);
  const Results results = simulate(machine, context, {0.0, 3.0}, precise());
  CHECK_THAT(results.events.times("a_to_b").at(0), WithinAbs(2.0, 1e-12));
  CHECK(machine.states() == std::vector<std::string>{"b", "a"});
}

TEST_CASE("a state machine says which of its names or conditions is wrong") {
  const StateMachineTransition none{"a", "a"}, never{.source = "a", .target = "a", .after = 0.0},
      both{.source = "a", .target = "a", .trigger = always, .after = 1.0};
  CHECK_THAT(refusal({}), Contains("expected one state or more"));
  CHECK_THAT(refusal({.states = {"a", "a"}}), Contains("the state 'a' is there twice"));
  CHECK_THAT(refusal({.states = {"a"}, .inputs = {"u", "u"}}), Contains("'u' is there twice"));
  CHECK_THAT(refusal({.states = {"a"}, .outputs = {{.name = "state"}}}),
             Contains("the output 'state' is there twice"));
  CHECK_THAT(refusal({.states = {"open"}, .initial = "opem"}), Contains("no state 'opem'"));
  CHECK_THAT(refusal({.states = {"a"}, .entry = {{"b", append(1.0)}}}),
             Contains("entry: there is no state 'b'"));
  CHECK_THAT(refusal({.states = {"a"}, .outputs = {{.name = "y", .levels = {{"b", 1.0}}}}}),
             Contains("output 'y': there is no state 'b'"));
  CHECK_THAT(refusal({.states = {"a"}, .transitions = {none}}), Contains("expected a guard"));
  CHECK_THAT(refusal({.states = {"a"}, .transitions = {never}}), Contains("after = 0 s"));
  CHECK_THAT(refusal({.states = {"a"}, .transitions = {both}}), Contains("found both"));
}
