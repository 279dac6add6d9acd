// Enabled and triggered subsystems. The law of an enabled one: time stands still in it while its
// control signal is not above 0.
#include "library_runs.hpp"
#include "saltus/simulation/evaluate.hpp"
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;
using support::Leaf, support::vec;

namespace {

constexpr double pi = 3.14159265358979323846;

std::shared_ptr<const System> shared(Diagram diagram) {
  return std::make_shared<Diagram>(std::move(diagram));
}

/// One block as a part: its first input, if it has one, and its first output.
template <class Block, class... Arguments>
std::shared_ptr<const System> part_of(Arguments&&... arguments) {
  DiagramBuilder builder;
  auto& block = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
  if (!block.input_names().empty()) builder.export_input(block.input(), "in");
  builder.export_output(block.output(), "out");
  return shared(builder.build("part"));
}

/// A subsystem whose first input, if it has one, comes from `source`, and whose last from `control`.
struct Driven {
  template <class Control, class Source>
  Driven(Diagram subsystem, const Control& control, const Source& source) {
    DiagramBuilder builder;
    const auto part = std::make_shared<Diagram>(std::move(subsystem));
    builder.add(part);
    if (part->input_names().size() > 1) builder.connect(source(builder).output(), part->input());
    const int last = static_cast<int>(part->input_names().size()) - 1;
    builder.connect(control(builder).output(), part->input(last));
    output = part->output();
    diagram.emplace(builder.build());
  }
  std::vector<double> at(const std::vector<double>& times, Index column = 0) const {
    return at_times(*diagram, output, times, column);
  }

  OutputPort output;
  std::optional<Diagram> diagram;
};

/// Above 0 in (0, pi), (2 pi, 3 pi), ...
const auto sine = [](DiagramBuilder& b) -> System& { return b.add<Sine>("sine"); };
const auto one = [](DiagramBuilder& b) -> System& { return b.add<Constant>("one", 1.0); };
const auto clock_of = [](DiagramBuilder& b) -> System& { return b.add<Clock>("clock"); };

/// The time from 0 to t in which `sine` is above 0.
double enabled_time(double t) {
  const double cycles = std::floor(t / (2.0 * pi));
  return cycles * pi + std::min(pi, t - cycles * 2.0 * pi);
}

const Numbers times{0.5, 3.0, 4.0, 6.0, 7.0, 9.0, 10.0, 12.0, 13.0};

}  // namespace

TEST_CASE("the states of an enabled subsystem rest while it is not enabled", "[library]") {
  const Driven scene(enabled_subsystem("sub", part_of<Integrator>()), sine, one);
  const Numbers x = scene.at(times);
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(x[i], WithinAbs(enabled_time(times[i]), solver_tolerance));
}

TEST_CASE("its states and its outputs are reset where the options say so", "[library]") {
  const Driven states(enabled_subsystem("sub", part_of<Integrator>(), {.resets_states = true}),
                      sine, one);
  CHECK_THAT(states.at({6.0})[0], WithinAbs(pi, solver_tolerance));  // held
  CHECK_THAT(states.at({7.0})[0], WithinAbs(7.0 - 2.0 * pi, solver_tolerance));
  const Driven outputs(
      enabled_subsystem("sub", part_of<Integrator>(),
                        {.resets_outputs = true, .initial_outputs = {{"out", -1.0}}}),
      sine, one);
  CHECK(outputs.at({6.0})[0] == -1.0);
  CHECK_THAT(outputs.at({7.0})[0], WithinAbs(7.0 - pi, solver_tolerance));
}

TEST_CASE("a held output is the signal at the end of the last time it was enabled", "[library]") {
  const Driven scene(enabled_subsystem("sub", part_of<Gain>(2.0)), sine, clock_of);
  const Numbers y = scene.at({1.0, 4.0, 6.0, 7.0, 11.0});
  // 2 pi twice: the error of a root is a few roundings of the time
  const Numbers expected{2.0, 2.0 * pi, 2.0 * pi, 14.0, 6.0 * pi};
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(expected[i], rounding));
}

/// The state at t is that of the same ball alone at the enabled time. Its impacts cannot be seen
/// while it rests, though its guard is below zero nowhere near them.
TEST_CASE("a guard is not seen while its subsystem is not enabled", "[library]") {
  const Eigen::Vector2d start(3.0, 0.0);
  const support::Ball alone({.e = 0.8});
  for (const auto& [name, method] : std::span(method_names).first(7)) {
    if (method == Method::taylor) continue;  // the ball is called
    CAPTURE(name);
    DiagramBuilder builder;
    DiagramBuilder inner;
    auto& ball = inner.add<support::Ball>(support::BallOptions{.e = 0.8});
    inner.export_output(ball.output(), "state");
    const auto part = std::make_shared<Diagram>(
        enabled_subsystem("sub", shared(inner.build("part")),
                          {.initial_outputs = {{"state", Eigen::VectorXd(start)}}}));
    builder.add(part);
    builder.connect(builder.add<Sine>("sine", SineOptions{.frequency = 5.0}).output(),
                    part->input());
    const Diagram diagram = builder.build();
    auto options = precise();
    options.ode_solver_method = method;
    const auto run = [&](const System& system, const Context& from, double end) {
      return simulate(system, from, {0.0, end}, options);
    };
    const auto context = diagram.create_context().with_subcontext(
        ball.system_id(), ball.create_context().with_continuous_state(start));
    for (const double t : {0.5, 1.0, 2.1, 4.4, 8.0}) {
      const auto found = run(diagram, context, t);
      const auto expected = run(alone, alone.create_context().with_continuous_state(start),
                                enabled_time(5.0 * t) / 5.0);
      const Eigen::VectorXd off =
          found.context.continuous_state() - expected.context.continuous_state();
      // BDF and Adams: some 100 times rtol in 8 s, by docs/solvers.md
      CHECK(off.cwiseAbs().maxCoeff() < 100.0 * solver_tolerance);
    }
  }
}

/// Without a state no solver is at work while no guard is seen, so the search begins anew after that.
TEST_CASE("guards of a subsystem without states fire at their times", "[library]") {
  const auto crossing = std::make_shared<support::Leaf>("crossing", [](support::Leaf& l) {
    const int in = l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "hit", .guard = [=](const At& at) { return at.u[in][0]; }});
    l.declare_output_port({.name = "out",
                           .calc = [](const At&, VectorRef y) { y.setZero(); },
                           .shape = Shape::scalar(),
                           .reads = Reads::time});
  });
  DiagramBuilder inner;
  inner.add(crossing);
  inner.export_input(crossing->input(), "in");
  inner.export_output(crossing->output(), "out");
  const auto pulse = [](DiagramBuilder& b) -> System& {
    return b.add<Pulse>("pulse", PulseOptions{.period = 20.0});
  };
  const Driven scene(enabled_subsystem("sub", shared(inner.build("part"))), pulse, sine);
  const auto results = simulate(*scene.diagram, scene.diagram->create_context(), {0.0, 100.0}, {});
  Numbers expected;
  for (int k = 1; k < 32; ++k)
    if (std::fmod(k * pi, 20.0) < 10.0) expected.push_back(k * pi);
  const auto times = results.events.times("sub.part.crossing.hit");
  REQUIRE(times.size() == expected.size());
  // The error of a root is some roundings of a time of 100 s.
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(times[i], WithinAbs(expected[i], 10.0 * rounding));
}

/// Ticks at 0, 1, 2, ...; sin > 0 at the ticks 1, 2, 3, 7, 8, 9. The delay counts these only.
TEST_CASE("updates are skipped while their subsystem is not enabled", "[library]") {
  const Driven scene(enabled_subsystem("sub", part_of<UnitDelay>(1.0)), sine, clock_of);
  CHECK(scene.at({1.5, 2.5, 3.1, 5.5, 7.5, 8.5, 9.3}) ==
        Numbers{0.0, 1.0, 2.0, 2.0, 3.0, 7.0, 8.0});
}

TEST_CASE("an enabled subsystem in another one is executed while both are", "[library]") {
  DiagramBuilder builder;
  const auto inner = std::make_shared<Diagram>(enabled_subsystem("inner", part_of<Integrator>()));
  builder.add(inner);
  const auto& cosine = builder.add<Sine>("cosine", SineOptions{.phase = pi / 2.0});
  builder.connect(cosine.output(), inner->input("enable"));
  builder.export_input(inner->input("in"), "in");
  builder.export_output(inner->output(), "out");
  const Driven scene(enabled_subsystem("outer", shared(builder.build("part"))), sine, one);
  // both above 0 in (0, pi / 2) and (2 pi, 5 pi / 2)
  CHECK_THAT(scene.at({6.0})[0], WithinAbs(pi / 2.0, solver_tolerance));
  CHECK_THAT(scene.at({12.0})[0], WithinAbs(pi, solver_tolerance));
}

TEST_CASE("a triggered subsystem takes its inputs at the triggers", "[library]") {
  const Driven rising(
      triggered_subsystem("sub", part_of<Gain>(1.0), {.initial_outputs = {{"out", -1.0}}}), sine,
      clock_of);
  const Numbers y = rising.at({1.0, 6.0, 7.0, 12.0, 13.0});
  const Numbers at_rise{0.0, 0.0, 2.0 * pi, 2.0 * pi, 4.0 * pi};  // it leaves 0 upwards at 0, too
  for (std::size_t i = 0; i < y.size(); ++i) CHECK_THAT(y[i], WithinAbs(at_rise[i], rounding));
  const Driven falling(triggered_subsystem("sub", part_of<Gain>(1.0), {.edge = Edge::falling}),
                       sine, clock_of);
  CHECK_THAT(falling.at({4.0})[0], WithinAbs(pi, rounding));
  const Driven either(triggered_subsystem("sub", part_of<Gain>(1.0), {.edge = Edge::either}), sine,
                      clock_of);
  CHECK_THAT(either.at({4.0})[0], WithinAbs(pi, rounding));
  CHECK_THAT(either.at({7.0})[0], WithinAbs(2.0 * pi, rounding));
}

TEST_CASE("a trigger that is true at the start of a run has no edge there", "[library]") {
  const auto cosine = [](DiagramBuilder& b) -> System& {
    return b.add<Sine>("cosine", SineOptions{.phase = pi / 2.0});
  };
  const Driven scene(
      triggered_subsystem("sub", part_of<Gain>(1.0), {.initial_outputs = {{"out", -1.0}}}), cosine,
      clock_of);
  CHECK(scene.at({4.0})[0] == -1.0);
  CHECK_THAT(scene.at({5.0})[0], WithinAbs(1.5 * pi, rounding));
}

/// y[k] = s[k] + 1, s[k+1] = y[k]: a delay in a loop counts the triggers at 0, 2 pi, 4 pi, ...
TEST_CASE("updates with an inherited period run at the triggers", "[library]") {
  DiagramBuilder builder;
  auto& delay = builder.add<UnitDelay>("delay", inherited_period);
  auto& more = builder.add<Adder>("more");
  builder.connect(delay.output(), more.input(0));
  builder.connect(more.output(), delay.input());
  builder.export_input(more.input(1), "in");
  builder.export_output(more.output(), "count");
  const Driven scene(triggered_subsystem("sub", shared(builder.build("part"))), sine, one);
  CHECK(scene.at({6.0, 7.0, 13.0, 19.0}) == Numbers{1.0, 2.0, 3.0, 4.0});
}

TEST_CASE("a part that a control signal cannot execute is refused, with what to do", "[library]") {
  const auto compiled = [](Diagram diagram) { return compile(diagram)->leaves.size(); };
  const auto driven = [&](Diagram subsystem) {
    return compiled(std::move(*Driven(std::move(subsystem), sine, clock_of).diagram));
  };
  const auto refuses = [](const auto& make, std::initializer_list<const char*> parts) {
    const std::string found = model_error(make);
    CAPTURE(found);
    for (const char* part : parts) CHECK(contains(found, part));
  };
  refuses([&] { driven(triggered_subsystem("sub", part_of<Integrator>())); },
          {"'sub.part.block'", "continuous state", "EnabledSubsystem"});
  refuses([&] { driven(triggered_subsystem("sub", part_of<UnitDelay>(0.5))); },
          {"inherited sample time, -1"});
  refuses(
      [&] {
        driven(triggered_subsystem("sub", part_of<Relay>(Relay::Options{.on_threshold = 1.0})));
      },
      {"zero crossing 'turn_on'"});
  refuses([&] { driven(triggered_subsystem("sub", part_of<Counter>())); },
          {"'count' follows an edge"});
  refuses([&] { driven(enabled_subsystem("sub", part_of<TransportDelay>(0.5))); }, {"history"});
  refuses([&] { driven(enabled_subsystem("sub", part_of<UnitDelay>(inherited_period))); },
          {"TriggeredSubsystem", "period > 0"});
  refuses(
      [&] { enabled_subsystem("sub", part_of<Gain>(1.0), {.initial_outputs = {{"otu", 1.0}}}); },
      {"unknown output 'otu'", "out"});
}

TEST_CASE("the plan says what is executed when", "[library]") {
  const Driven scene(enabled_subsystem("sub", part_of<Integrator>()), sine, one);
  CHECK(contains(compile(*scene.diagram)->describe(),
                 "block 'sub.part.block' is executed while 'sub.enable.out' is true"));
}

/// The inner control signal is the sine, the outer one is true before 2.5 pi and from 4.25 pi on: y rises to
/// 3 pi / 2, rests, and from 4.25 pi on it goes on until 5 pi.
TEST_CASE("a part inside a part is enabled while both control signals are true", "[library]") {
  DiagramBuilder between;
  const auto inner = shared(enabled_subsystem("inner", part_of<Integrator>()));
  between.add(inner);
  between.export_input(inner->input("in"), "in");
  between.export_input(inner->input("enable"), "inner");
  between.export_output(inner->output("out"), "out");
  const auto outer = shared(enabled_subsystem("outer", shared(between.build("between"))));
  DiagramBuilder builder;
  builder.add(outer);
  builder.connect(one(builder).output(), outer->input("in"));
  builder.connect(sine(builder).output(), outer->input("inner"));
  auto& control =
      builder.add<DataSource>("control", vec({0.0, 2.5 * pi, 4.25 * pi}), vec({1.0, 0.0, 1.0}),
                              DataSourceOptions{.interpolation = "zero_order_hold"});
  builder.connect(control.output(), outer->input("enable"));
  const Diagram diagram = builder.build();
  const Numbers at{1.0, 4.0, 2.25 * pi, 3.0 * pi, 4.2 * pi, 4.5 * pi, 5.5 * pi, 6.0 * pi};
  const Numbers expected{1.0, pi, 1.25 * pi, 1.5 * pi, 1.5 * pi, 1.75 * pi, 2.25 * pi, 2.25 * pi};
  const std::vector<double> y = at_times(diagram, outer->output("out"), at, 0);
  for (std::size_t i = 0; i < at.size(); ++i)
    CHECK_THAT(y[i], WithinAbs(expected[i], solver_tolerance));
}

/// x' = p while the control signal is true, until 2 s: y = 2 p from then on. The input that jumps at 2 s
/// is not in it.
TEST_CASE("a held output has the derivative that it had before the instant", "[library]") {
  const auto level = std::make_shared<Leaf>("level", [](Leaf& l) {
    const int in = l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    const ParameterIndex p = l.declare_dynamic_parameter("p", 3.0);
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [=](const At& at, VectorRef dx) {
                                  dx << at.parameter(p)[0];
                                }});
    l.declare_output_port(
        {.name = "out", .calc = [=](const At& at, VectorRef y) { y << at.x[0] * at.u[in][0]; }});
  });
  const DataSourceOptions steps{.interpolation = "zero_order_hold"};
  DiagramBuilder builder;
  const auto part = shared(enabled_subsystem("part", level));
  builder.add(part);
  auto& factor = builder.add<DataSource>("factor", vec({0.0, 2.0}), vec({1.0, 5.0}), steps);
  auto& control = builder.add<DataSource>("control", vec({0.0, 2.0}), vec({1.0, 0.0}), steps);
  builder.connect(factor.output(), part->input("in"));
  builder.connect(control.output(), part->input("enable"));
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 3.0}, {.sensitivity = {"part.level.p"}});
  const Context& end = results.context;
  CHECK_THAT(end.discrete_state()[0], WithinAbs(6.0, solver_tolerance));
  // by differences, whose error is 1e-10 of the values
  CHECK_THAT(results.sensitivities.discrete_state[0], WithinAbs(2.0, 1e-8));
}
