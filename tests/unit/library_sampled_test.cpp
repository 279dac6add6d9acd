// Blocks that sample their inputs: at a tick all outputs change first, in the order of the wires.
#include "library_runs.hpp"
#include "saltus/simulation/evaluate.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

/// A source, blocks in a row, and the last one's output.
struct Row {
  template <class Add>
  explicit Row(Add add) {
    DiagramBuilder builder;
    last = &add(builder);
    diagram.emplace(builder.build());
  }
  std::vector<double> at(const std::vector<double>& times) const {
    return at_times(*diagram, last->output(), times);
  }
  const System* last = nullptr;
  std::optional<Diagram> diagram;
};

/// Wires blocks one after the other, and returns the last.
template <class Block, class... Arguments>
Block& behind(DiagramBuilder& builder, const System& source, const char* name,
              Arguments&&... arguments) {
  auto& block = builder.add<Block>(name, std::forward<Arguments>(arguments)...);
  builder.connect(source.output(), block.input());
  return block;
}

std::vector<double> ticks(int n, double dt) {
  std::vector<double> times;
  for (int k = 0; k < n; ++k) times.push_back(k * dt);
  return times;
}

}  // namespace

/// u[k] = k passes five blocks without memory, and is k at tick k behind each.
TEST_CASE("sampled blocks in a row add no delay", "[library][sampled]") {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  const Row row([&](DiagramBuilder& builder) -> System& {
    auto& clock = builder.add<DiscreteClock>("clock", 1.0);
    auto& a = behind<RateTransition>(builder, clock, "a", 1.0);
    auto& b = behind<FilterDiscrete>(builder, a, "b", 1.0, one);
    auto& c = behind<TransferFunctionDiscrete>(builder, b, "c", 1.0, one, one);
    auto& d = behind<PIDDiscrete>(builder, c, "d", 1.0);
    return behind<RateTransition>(builder, d, "e", 1.0);
  });
  CHECK(row.at(ticks(5, 1.0)) == Numbers{0.0, 1.0, 2.0, 3.0, 4.0});
}

TEST_CASE("delays in a row add up, to each other and to a UnitDelay", "[library][sampled]") {
  const Row row([](DiagramBuilder& builder) -> System& {
    auto& clock = builder.add<DiscreteClock>("clock", 1.0);
    auto& a = behind<DelayN>(builder, clock, "a", 1.0, 2, DelayN::Options{-1.0});
    auto& b = behind<UnitDelay>(builder, a, "b", 1.0, UnitDelay::Options{-2.0});
    return behind<DelayN>(builder, b, "c", 1.0, 1, DelayN::Options{-3.0});
  });
  CHECK(row.at(ticks(7, 1.0)) == Numbers{-3.0, -2.0, -1.0, -1.0, 0.0, 1.0, 2.0});
}

/// The slow block sees the fast one as it is at the common tick. A ZeroOrderHold would show 3.
TEST_CASE("a slow block reads a fast one at their common tick", "[library][sampled]") {
  const Row row([](DiagramBuilder& builder) -> System& {
    auto& clock = builder.add<DiscreteClock>("clock", 0.25);
    return behind<RateTransition>(builder, clock, "slow", 1.0);
  });
  CHECK(row.at({0.9, 1.0, 1.9, 2.0}) == Numbers{0.0, 1.0, 1.0, 2.0});
}

/// 1000 ticks of 1/3 s: each adds dt * 3 = 1, to the last bit. The second run goes on from a tick.
TEST_CASE("ticks are counted exactly, in one run and in two", "[library][sampled]") {
  const double dt = 1.0 / 3.0;
  const BlockRun<IntegratorDiscrete> scene(fed_by<Constant>(3.0), dt);
  const Numbers y = scene.at(ticks(1001, dt));
  for (std::size_t k = 0; k < y.size(); ++k) CHECK(y[k] == static_cast<double>(k));
  const Results first = scene.run(100 * dt);
  const Results second = simulate(scene.diagram, first.context, {100 * dt, 1000 * dt}, precise());
  CHECK(second.context.discrete_state() == scene.run(1000 * dt).context.discrete_state());
}

TEST_CASE("a run that begins between two ticks shows the value before the first", "[library]") {
  const BlockRun<RateTransition> scene(fed_by<Constant>(7.0), 1.0, RateTransition::Options{-1.0});
  auto options = precise();
  options.recorded_signals = {{"y", scene.block->output()}};
  const auto results =
      simulate(scene.diagram, scene.diagram.create_context(0.5), {0.5, 1.5}, options);
  const auto y = results.output("y");
  CHECK(y(0, 0) == -1.0);
  CHECK(y(y.rows() - 1, 0) == 7.0);
}

/// The tick at 2 s belongs to the first run: the second, whose context was changed, has it no more.
TEST_CASE("a tick is not repeated after a change by hand", "[library][sampled]") {
  DiagramBuilder builder;
  auto& one = builder.add<Constant>("one", 1.0);
  auto& count = behind<IntegratorDiscrete>(builder, one, "count", 1.0);
  const Diagram diagram = builder.build();
  const Results first = simulate(diagram, diagram.create_context(), {0.0, 2.0}, precise());
  const Context changed = first.context.with_parameter("one.value", 10.0);
  const Results second = simulate(diagram, changed, {2.0, 4.5}, precise());
  CHECK(evaluate_output(diagram, count.output(), second.context).values[0] == 13.0);
}

/// Root and tick are at 1 s. In the row before the instant the relation that fired has its new side
/// (5.1), and the value that samples it still has its old one.
TEST_CASE("the row before a tick shows what was sampled before it", "[library][sampled]") {
  DiagramBuilder builder;
  auto& clock = builder.add<Clock>("clock");
  auto& one = builder.add<Constant>("one", 1.0);
  auto& above = builder.add<Comparator>("above", ">");
  builder.connect(clock.output(), above.input(0));
  builder.connect(one.output(), above.input(1));
  auto& sampled = behind<RateTransition>(builder, above, "sampled", 1.0);
  auto& sum = behind<Integrator>(builder, above, "sum");  // so that the relation is located
  const Diagram diagram = builder.build();
  auto options = precise();
  options.recorded_signals = {
      {"above", above.output()}, {"sampled", sampled.output()}, {"sum", sum.output()}};
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 1.5}, options);
  const auto first = std::ranges::find(results.time, 1.0) - results.time.begin();
  REQUIRE(first + 1 < results.output("above").rows());
  CHECK(results.output("above")(first, 0) == 1.0);
  CHECK(results.output("sampled")(first, 0) == 0.0);
  CHECK(results.output("sampled")(first + 1, 0) == 1.0);
}

/// x' = -K y with y = x at the last tick: x[k+1] = (1 - K dt) x[k]. The derivative is constant
/// between ticks, so each step is exact.
TEST_CASE("a sampled loop has the closed form of its difference equation", "[library][sampled]") {
  DiagramBuilder builder;
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = 1.0});
  auto& sampled = behind<RateTransition>(builder, x, "sampled", 0.1);
  auto& gain = behind<Gain>(builder, sampled, "gain", -3.0);
  builder.connect(gain.output(), x.input());
  const Diagram diagram = builder.build();
  double exact = 1.0;
  for (const double found : at_times(diagram, x.output(), ticks(30, 0.1))) {
    CHECK_THAT(found, WithinAbs(exact, rounding));
    exact *= 1.0 - 3.0 * 0.1;
  }
}

/// The kink of the Saturate does not reach the derivative: what it reaches is held between ticks.
TEST_CASE("what is sampled is held, and nothing behind it is located", "[library][sampled]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& limit = behind<Saturate>(builder, sine, "limit", Saturate::Options{.upper_limit = 0.5});
  auto& sampled = behind<RateTransition>(builder, limit, "sampled", 0.1);
  auto& sum = behind<Integrator>(builder, sampled, "sum");
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram, {{"y", sampled.output()}, {"x", sum.output()}});
  CHECK(plan->guards.empty());
  CHECK(plan->needs.derivatives.empty());
  CHECK(plan->node(plan->taps[0].node).rate == Rate::held);
}

TEST_CASE("a loop through sampled blocks alone is an algebraic loop", "[library][sampled]") {
  DiagramBuilder builder;
  auto& sum = builder.add<Adder>("sum", "++");
  auto& one = builder.add<Constant>("one", 1.0);
  auto& filter = behind<FilterDiscrete>(builder, sum, "filter", 1.0, Eigen::VectorXd::Ones(1));
  builder.connect(filter.output(), sum.input(0));
  builder.connect(one.output(), sum.input(1));
  CHECK(contains(model_error([&] { compile(builder.build()); }), "algebraic loop"));
}

/// The integrator reads its input for the next tick only: the loop counts.
TEST_CASE("a forward integrator closes a loop", "[library][sampled]") {
  DiagramBuilder builder;
  auto& x = builder.add<IntegratorDiscrete>("x", 0.5, IntegratorDiscrete::Options{1.0});
  auto& gain = behind<Gain>(builder, x, "gain", 2.0);
  builder.connect(gain.output(), x.input());
  const Diagram diagram = builder.build();
  CHECK(at_times(diagram, x.output(), ticks(5, 0.5)) == Numbers{1.0, 2.0, 4.0, 8.0, 16.0});
}

TEST_CASE("a DiscreteClock shows the time of the last tick", "[library][sampled]") {
  const BlockRun<DiscreteClock> scene([](DiagramBuilder&, auto&) {}, 0.25);
  CHECK(scene.at({0.0, 0.2, 0.25, 0.9, 1.0}) == Numbers{0.0, 0.0, 0.25, 0.75, 1.0});
}

/// True from 1.2 to 2.4: the ticks 2 and 4 see a change.
TEST_CASE("an edge between two ticks is seen at the second, once", "[library][sampled]") {
  const auto pulse =
      fed_by<Pulse>(Pulse::Options{.period = 9.0, .pulse_width = 1.2 / 9.0, .phase_delay = 1.2});
  const auto seen = [&](Edge edge) {
    const EdgeDetection::Options options{.edge = edge};
    return BlockRun<EdgeDetection>(pulse, 1.0, options).at({1.5, 2.0, 2.9, 3.0, 3.9, 4.0});
  };
  CHECK(seen(Edge::rising) == Numbers{0.0, 1.0, 1.0, 0.0, 0.0, 0.0});
  CHECK(seen(Edge::falling) == Numbers{0.0, 0.0, 0.0, 1.0, 1.0, 0.0});
  CHECK(seen(Edge::either) == Numbers{0.0, 1.0, 1.0, 1.0, 1.0, 0.0});
}

TEST_CASE("an input that is true at the start has an edge only if it was false", "[library]") {
  const auto first = [](bool before) {
    return BlockRun<EdgeDetection>(fed_by<Constant>(1.0), 1.0,
                                   EdgeDetection::Options{.initial_state = before})
        .at({0.0})[0];
  };
  CHECK(first(false) == 1.0);
  CHECK(first(true) == 0.0);
}

TEST_CASE("periods and counts that are none are refused", "[library][sampled]") {
  CHECK(model_error([] { DiscreteClock("c", 0.0); }) ==
        "block 'c': dt = 0 s; expected a finite time > 0 s");
  CHECK(contains(model_error([] { DelayN("d", 1.0, 0); }), "expected 1 ticks of delay or more"));
}
