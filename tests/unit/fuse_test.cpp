// Fused formulas give the numbers of single calls to the last bit, in every walk and in whole runs,
// and leave out nothing but calls.
#include <random>

#include "saltus/library/library.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/simulator.hpp"
#include "support/allocations.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// The same plan with a call for each block.
std::shared_ptr<const Plan> apart(const Plan& plan) {
  Plan copy = plan;
  copy.walks.derivatives = {}, copy.walks.guards = {};
  return std::make_shared<const Plan>(std::move(copy));
}

/// v |v|, as a formula.
Formula drag() {
  return [](const auto& at) {
    using std::abs;
    return at.u(0) * abs(at.u(0));
  };
}

/// Blocks of the library put together by chance: each reads what was there before it, states are
/// fed at the end. Widths 1, 3 and, too wide to be fused, 19.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  Diagram diagram() {
    for (int i = 0; i < 4; ++i) add_state(1);
    add_state(3), add_state(19);
    keep(builder_.add<Sine>(name(), Sine::Options{.amplitude = number(), .frequency = 3.0}), 1);
    keep(builder_.add<Ramp>(name(), Ramp::Options{.slope = number(), .start_time = 0.5}), 1);
    keep(builder_.add<Constant>(name(), number()), 1);
    keep(builder_.add<Step>(name(), Step::Options{.end_value = number()}), 1);
    for (int i = 0; i < 40; ++i) add_block();
    for (std::size_t i = 0; i < states_.size(); ++i)
      builder_.connect(source(states_[i].second), states_[i].first);
    return builder_.build("chance");
  }

 private:
  using Source = std::pair<OutputPort, int>;

  std::string name() { return text("b", count_++); }
  double number() { return std::uniform_real_distribution(-2.0, 2.0)(random_); }
  int below(std::size_t n) {
    return std::uniform_int_distribution(0, static_cast<int>(n) - 1)(random_);
  }
  void keep(const System& block, int width) { sources_.push_back({block.output(), width}); }

  /// Some signal of this width.
  OutputPort source(int width) {
    for (;;) {
      const Source& found = sources_[static_cast<std::size_t>(below(sources_.size()))];
      if (found.second == width) return found.first;
    }
  }
  int some_width() { return sources_[static_cast<std::size_t>(below(sources_.size()))].second; }

  void add_state(int width) {
    const bool limits = count_ % 2 == 0;
    const auto& block = builder_.add<Integrator>(
        name(), Integrator::Options{.initial_state = Value(Eigen::VectorXd::Ones(width)),
                                    .enable_limits = limits,
                                    .lower_limit = -3.0,
                                    .upper_limit = 3.0});
    states_.push_back({block.input(), width});
    keep(block, width);
  }

  template <class Block, class... Arguments>
  void add(const std::vector<int>& widths, int width, Arguments&&... arguments) {
    const auto& block = builder_.add<Block>(name(), std::forward<Arguments>(arguments)...);
    for (std::size_t k = 0; k < widths.size(); ++k)
      builder_.connect(source(widths[k]), block.input(static_cast<int>(k)));
    keep(block, width);
  }

  void add_block() {
    const int w = some_width();
    switch (below(12)) {
      case 0:
        return add<Gain>({w}, w, number());
      case 1:
        return add<Offset>({w}, w, number());
      case 2:
        return add<Adder>({w, 1, w}, w, "+--");
      case 3:
        return add<Adder>({w, w}, w, "-+");
      case 4:
        return add<Product>({w, w, 1}, w, "**/");
      case 5:
        return add<Abs>({w}, w);
      case 6:
        return add<Saturate>({w}, w, Saturate::Options{.lower_limit = -1.0, .upper_limit = 1.5});
      case 7:
        return add<Switch>({w, 1, w}, w, Switch::Options{.threshold = number()});
      case 8:
        return add<Multiplexer>({1, 1, 1}, 3, 3);
      case 9:
        return add<Demultiplexer>({3}, 1, 3);
      case 10:  // a call between formulas
        return add<FunctionBlock>({w}, w, [](double u) { return std::cos(u); });
      default:
        return add<FunctionBlock>({w}, w, drag());
    }
  }

  std::mt19937 random_;
  DiagramBuilder builder_;
  std::vector<Source> sources_;
  std::vector<std::pair<InputPort, int>> states_;
  int count_ = 0;
};

Eigen::VectorXd some(Index n, std::mt19937& random) {
  return Eigen::VectorXd::NullaryExpr(
      n, [&] { return std::uniform_real_distribution(-4.0, 4.0)(random); });
}

/// The same number, or no number both.
bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return std::ranges::equal(a, b, [](double p, double q) {
    return (p == q && std::signbit(p) == std::signbit(q)) || (std::isnan(p) && std::isnan(q));
  });
}

/// A ball with drag over a floor that oscillates: relations, resets, a formula and a call.
Diagram ball() {
  DiagramBuilder builder;
  const Integrator::Options reset{.enable_reset = true, .enable_external_reset = true};
  auto& v = builder.add<Integrator>("v", reset);
  Integrator::Options high = reset;
  high.initial_state = 5.0;
  auto& y = builder.add<Integrator>("y", high);
  auto& floor =
      builder.add<Sine>("floor", Sine::Options{.amplitude = 0.1, .frequency = 2.0, .bias = -0.5});
  auto& below = builder.add<Comparator>("below", "<");
  auto& rebound = builder.add<Gain>("rebound", -0.8);
  auto& weight = builder.add<Constant>("weight", -9.81);
  auto& drags = builder.add<FunctionBlock>("drag", drag());
  auto& wind = builder.add<FunctionBlock>("wind", [](double u) { return 0.1 * std::sin(u); });
  auto& sum = builder.add<Adder>("sum", "+-+");
  builder.connect(v.output(), drags.input());
  builder.connect(y.output(), wind.input());
  builder.connect(weight.output(), sum.input(0));
  builder.connect(drags.output(), sum.input(1));
  builder.connect(wind.output(), sum.input(2));
  builder.connect(sum.output(), v.input("in"));
  builder.connect(v.output(), y.input("in"));
  builder.connect(y.output(), below.input(0));
  builder.connect(floor.output(), below.input(1));
  builder.connect(below.output(), v.input("reset_trigger"));
  builder.connect(below.output(), y.input("reset_trigger"));
  builder.connect(v.output(), rebound.input());
  builder.connect(rebound.output(), v.input("reset_value"));
  builder.connect(floor.output(), y.input("reset_value"));
  return builder.build("ball");
}

/// x' = f^n(x), where f is u + 1/2: a chain of n Offsets.
Diagram chain(int n) {
  DiagramBuilder builder;
  auto& state = builder.add<Integrator>("state");
  OutputPort last = state.output();
  for (int i = 0; i < n; ++i) {
    auto& block = builder.add<Offset>(text("offset_", i), 0.5);
    builder.connect(last, block.input());
    last = block.output();
  }
  builder.connect(last, state.input());
  return builder.build("chain");
}

}  // namespace

TEST_CASE("fused formulas give the bits of single calls, whatever they are put together to",
          "[fuse]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  INFO("seed " << seed);
  const Diagram diagram = Chance(seed).diagram();
  const auto plan = compile(diagram);
  REQUIRE(plan->walks.derivatives.fuses());
  REQUIRE(plan->walks.derivatives.last);
  Machine fused(plan), single(apart(*plan));
  const Context context = diagram.create_context();
  fused.load(context), single.load(context);
  std::mt19937 random(seed);
  Eigen::VectorXd f(plan->nx), f1(plan->nx), g(plan->look_slots), g1(plan->look_slots);
  g.setZero(), g1.setZero();
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = some(plan->nx, random);
    for (std::size_t k = 0; k < plan->nodes.size(); ++k) {  // relations, whichever way they stand
      const Node& node = plan->nodes[k];
      for (Index j = 0; node.located && j < node.place.size; ++j) {
        const double truth = random() % 2 == 0 ? 1.0 : 0.0;
        fused.y[node.place.offset + j] = single.y[node.place.offset + j] = truth;
      }
    }
    const double t = 0.1 * i;
    fused.derivative(t, x.data(), f.data()), single.derivative(t, x.data(), f1.data());
    CHECK(same(f, f1));
    fused.guards(t, x.data(), g.data()), single.guards(t, x.data(), g1.data());
    CHECK(same(g, g1));
  }
  CHECK(fused.rhs_calls == single.rhs_calls);
}

TEST_CASE("a run of fused blocks is the run of single ones, to the last bit", "[fuse]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Diagram diagram = ball();
  const auto plan = compile(diagram, {{"y", diagram["y"].output()}});
  REQUIRE(plan->walks.derivatives.nodes.size() == 2);  // drag and sum
  REQUIRE(plan->walks.guards.nodes.size() == 1);       // floor
  const auto run = [&](std::shared_ptr<const Plan> with) {
    Simulator simulator(std::move(with), {.rtol = 1e-8, .ode_solver_method = method});
    simulator.initialize(diagram.create_context());
    simulator.advance_to(6.0);
    return simulator.take_results();
  };
  const Results fused = run(plan), single = run(apart(*plan));
  CHECK(fused.time == single.time);
  CHECK(column(fused, "y") == column(single, "y"));
  CHECK(same_bits(fused.context, single.context));
  CHECK(same_bits(fused.events, single.events));
  CHECK(count(fused.events, EventKind::zero_crossing) > 5);
  CHECK(fused.statistics.steps == single.statistics.steps);
  CHECK(fused.statistics.right_hand_side_calls == single.statistics.right_hand_side_calls);
  CHECK(fused.statistics.guard_calls == single.statistics.guard_calls);
}

TEST_CASE("a plan says what is fused", "[fuse]") {
  const std::string what = compile(ball())->describe();
  INFO(what);
  CHECK(contains(what, "computed for the derivatives: 3 (drag.out, wind.out, sum.out)"));
  CHECK(contains(what,
                 "of these fused into 1 call: 2 (drag.out, sum.out)\n"
                 "    and with them 2 of 2 derivatives of blocks"));
  CHECK(contains(what,
                 "of these fused into 1 call: 1 (floor.out)\n"
                 "    and with them 1 of 1 guards"));
  const Leaf leaf("leaf", [](Leaf& l) { declare_ramp(l); });
  CHECK(!contains(compile(leaf)->describe(), "fused"));
}

TEST_CASE("a chain is one function that writes no value between its blocks down", "[fuse]") {
  const int n = GENERATE(1, 10, 1000, 10000);
  const Diagram diagram = chain(n);
  const auto plan = compile(diagram);
  CHECK(static_cast<int>(plan->walks.derivatives.nodes.size()) == n);
  for (const Walk::Stage& stage : plan->walks.derivatives.stages) {
    CHECK(!stage.fused);
    CHECK(stage.calls.empty());
  }
  Machine machine(plan);
  machine.load(diagram.create_context());
  const double x = 1.0;
  double f = 0.0;
  machine.derivative(0.0, &x, &f);
  CHECK(f == 1.0 + 0.5 * n);  // halves add up without rounding
  CHECK(machine.y.isZero());
  const long asked = allocations_of([&] {
    for (int i = 0; i < 100; ++i) machine.derivative(0.0, &x, &f);
  });
  CHECK(asked <= 0);  // -1: they cannot be counted here
}

TEST_CASE("what has no formula is called once each time, and sees what a formula before it gives",
          "[fuse]") {
  DiagramBuilder builder;
  int calls = 0;
  auto& state = builder.add<Integrator>("state", Integrator::Options{.initial_state = 3.0});
  auto& before = builder.add<Gain>("before", 2.0);
  auto& opaque = builder.add<Leaf>("opaque", [&](Leaf& l) {
    l.declare_input_port();
    l.declare_output_port(
        {.calc = [&](const At& at) { return ++calls, at.u(0) + 1.0; }, .reads = Reads::inputs});
  });
  auto& after = builder.add<Adder>("after", "++");
  builder.connect(state.output(), before.input());
  builder.connect(before.output(), opaque.input());
  builder.connect(before.output(), after.input(0)),
      builder.connect(opaque.output(), after.input(1));
  builder.connect(after.output(), state.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  Machine machine(plan);
  machine.load(diagram.create_context());
  double f = 0.0;
  for (int i = 0; i < 5; ++i) machine.derivative(0.0, machine.x.data(), &f);
  CHECK(f == 6.0 + 7.0);
  CHECK(calls == 5);
  CHECK(contains(plan->describe(), "of these fused into 2 calls: 2 (before.out, after.out)"));
}

TEST_CASE("a block of one's own joins by its formulas: of an output, a derivative, a guard",
          "[fuse]") {
  DiagramBuilder builder;
  auto& oscillator = builder.add<Leaf>("oscillator", [](Leaf& l) {
    const ParameterIndex k = l.declare_dynamic_parameter("stiffness", 4.0);
    l.declare_input_port({.shape = Shape::scalar()});
    l.declare_continuous_state({.initial = vec({1.0, 0.5}),
                                .reads = Reads::inputs | Reads::continuous_state,
                                .formula = [k](const auto& at, Index i) {
                                  return i == 0 ? at.x(1) : at.u(0) - at.p(k) * at.x(0);
                                }});
    l.declare_output_port(
        {.name = "energy", .reads = Reads::continuous_state, .formula = [k](const auto& at) {
           return 0.5 * (at.x(1) * at.x(1) + at.p(k) * (at.x(0) * at.x(0)));
         }});
    l.declare_zero_crossing({.name = "turn",
                             .inputs = std::vector<int>{},
                             .formula = [](const auto& at) { return at.x(1); }});
  });
  auto& damping = builder.add<Gain>("damping", -0.25);
  builder.connect(oscillator.output("energy"), damping.input());
  builder.connect(damping.output(), oscillator.input());
  const Diagram diagram = builder.build();
  const auto plan = compile(diagram);
  CHECK(plan->walks.derivatives.nodes.size() == 2);
  Machine machine(plan);
  machine.load(diagram.create_context());
  Eigen::Vector2d f;
  double g = 0.0;
  machine.derivative(0.0, machine.x.data(), f.data());
  machine.guards(0.0, machine.x.data(), &g);
  CHECK(f == Eigen::Vector2d(0.5, -0.25 * (0.5 * (0.25 + 4.0)) - 4.0));
  CHECK(g == 0.5);
}

TEST_CASE("a wide formula gives entry by entry what narrow ones give", "[fuse]") {
  const Index n = GENERATE(1, 7, 8, 19);
  const Leaf leaf("leaf", [n](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 0.1, 0.9),
                                .reads = Reads::continuous_state | Reads::time,
                                .formula = [](const auto& at) {
                                  using std::sin, std::atan2, std::exp;
                                  const auto x = at.x();
                                  return at.choose(x < 0.5, sin(x) / atan2(x, x + at.time()),
                                                   -exp(x) * x);
                                }});
  });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  Eigen::VectorXd f(n);
  machine.derivative(2.0, machine.x.data(), f.data());
  for (Index i = 0; i < n; ++i) {
    const double x = machine.x[i];
    CHECK(f[i] == (x < 0.5 ? std::sin(x) / std::atan2(x, x + 2.0) : -std::exp(x) * x));
  }
}

TEST_CASE("of fused blocks the one that gives NaN or Inf is named", "[fuse]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  auto& state = builder.add<Integrator>("state", Integrator::Options{.initial_state = 1.0});
  auto& minus = builder.add<Constant>("minus", -1.0);
  auto& zero = builder.add<Gain>("zero", 0.0);
  auto& ratio = builder.add<Product>("ratio", "*/");
  auto& sum = builder.add<Adder>("sum", "++");
  builder.connect(state.output(), zero.input());
  builder.connect(zero.output(), ratio.input(0)), builder.connect(zero.output(), ratio.input(1));
  builder.connect(ratio.output(), sum.input(0)), builder.connect(minus.output(), sum.input(1));
  builder.connect(sum.output(), state.input());
  const Diagram diagram = builder.build();
  REQUIRE(compile(diagram)->walks.derivatives.nodes.size() == 3);
  const std::string what = message<SimulationError>([&] {
    simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  });
  CHECK(contains(what, "output 'ratio.out', which a derivative reads, is not finite"));
}

TEST_CASE("a value that has a function has no formula beside it", "[fuse]") {
  const auto function = [](const At& at) { return at.time; };
  const Formula formula = [](const auto& at) { return at.time(); };
  const auto refused = [](auto declare) {
    return message<ModelError>([&] { const Leaf leaf("leaf", declare); });
  };
  const std::string both = " has a function and a formula; expected one of them";
  CHECK(refused([&](Leaf& l) {
          l.declare_output_port({.name = "y", .calc = function, .formula = formula});
        }) == "block 'leaf': output 'y'" + both);
  CHECK(refused([&](Leaf& l) {
          l.declare_continuous_state({.initial = vec({0.0}), .ode = function, .formula = formula});
        }) == "block 'leaf': the continuous state" + both);
  CHECK(refused([&](Leaf& l) {
          l.declare_relation({.name = "r", .guard = function, .formula = formula});
        }) == "block 'leaf': relation 'r'" + both);
  CHECK(refused([&](Leaf& l) {
          l.declare_zero_crossing({.name = "c", .guard = function, .formula = formula});
        }) == "block 'leaf': zero crossing 'c'" + both);
}
