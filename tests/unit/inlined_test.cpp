// Right-hand sides compiled together with the steps: the same runs as the plain declaration.
#include "saltus/solver/inlined.hpp"

#include "saltus/simulation/simulate.hpp"
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// N lags in a ring, each with a drive of its own; the first one is pushed up where it falls to
/// 0.2.
template <int N, bool Inlined>
class Ring final : public LeafSystem {
 public:
  Ring() : LeafSystem("ring") {
    RightHandSide ode = &Ring::ode;
    if (Inlined) ode = inlined<N>(method<&Ring::ode>);
    declare_continuous_state({.initial = Eigen::VectorXd::Ones(N), .ode = std::move(ode)});
    declare_zero_crossing({.name = "push",
                           .guard = method<&Ring::level>,
                           .reset_map = method<&Ring::push>,
                           .direction = Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    for (Index i = 0; i < N; ++i) {
      const double x = at.x[i], next = at.x[(i + 1) % N];
      xdot[i] = -0.5 * x * std::abs(x) + 0.2 * next + std::sin(at.time + static_cast<double>(i));
    }
  }
  double level(const At& at) const { return at.x[0] - 0.2; }
  void push(const At& at, Next& next) const {
    Eigen::VectorXd x = at.x;
    x[0] = 0.7;
    next.set_continuous_state(x);
  }
};

template <int N>
void same_runs(Method name) {
  const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = name};
  const Ring<N, true> fast;
  const Ring<N, false> plain;
  const Results a = simulate(fast, fast.create_context(), {0.0, 20.0}, options),
                b = simulate(plain, plain.create_context(), {0.0, 20.0}, options);
  INFO(name << ", " << N << " states");
  CHECK(a.statistics.steps == b.statistics.steps);
  CHECK(a.statistics.right_hand_side_calls == b.statistics.right_hand_side_calls);
  REQUIRE(a.events.times("push").size() == b.events.times("push").size());
  CHECK(a.events.times("push").size() > 3);
  // The same operations in the same order: equal but where a compiler fuses them, a rounding each
  // of some 1e4 operations, damped by the lags.
  const Eigen::VectorXd x = a.context.continuous_state(), y = b.context.continuous_state();
  CHECK((x - y).cwiseAbs().maxCoeff() <= 1e4 * eps);
}

}  // namespace

TEST_CASE("an inlined right-hand side: the same steps, calls, events and states", "[inlined]") {
  for (const Method name : methods) {
    same_runs<1>(name);
    same_runs<2>(name);
    same_runs<3>(name);
    same_runs<4>(name);
    same_runs<7>(name);
  }
}

TEST_CASE("an inlined right-hand side sees the present mode in each step", "[inlined]") {
  // It rises by 1 a second to 1, and falls by 2 a second to 0: a turn at 1 s, 1.5 s, 2.5 s, 3 s, ...
  const auto method = GENERATE(from_range(methods));
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({0.0}), .ode = inlined<1>([](const At& at) {
                                                         return at.mode == 0 ? 1.0 : -2.0;
                                                       })});
    l.declare_default_mode(0);
    l.declare_zero_crossing({.name = "top",
                             .guard = [](const At& at) { return 1.0 - at.x[0]; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "bottom",
                             .guard = [](const At& at) { return at.x[0]; },
                             .start_mode = 1,
                             .end_mode = 0});
  });
  std::vector<double> turns;
  for (int k = 0; k < 6; ++k) turns.insert(turns.end(), {1.5 * k + 1.0, 1.5 * k + 1.5});
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 9.2}, {.ode_solver_method = method});
  INFO(method);
  // Every method is exact on a line; each of twelve turns adds some roundings of the time.
  CHECK(worst(firing_times(results.events), turns) <= 12.0 * 32.0 * eps * 9.2);
}

TEST_CASE("an inlined right-hand side of a block beside others is called as any", "[inlined]") {
  const auto decay = [](double rate) {
    return [rate](Leaf& l) {
      const auto ode = [rate](const Leaf::At& at, Leaf::VectorRef xdot) {
        xdot[0] = -rate * at.x[0];
      };
      l.declare_continuous_state({.initial = vec({1.0}), .ode = inlined<1>(ode)});
    };
  };
  DiagramBuilder builder;
  builder.add<Leaf>("slow", decay(1.0));
  builder.add<Leaf>("fast", decay(3.0));
  const Diagram diagram = builder.build();
  const Results results =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.rtol = 1e-10, .atol = 1e-12});
  // Ten tolerances (numerics.md 2); the problem contracts.
  CHECK(std::abs(results.context.continuous_state()[0] - std::exp(-1.0)) < 1e-9);
  CHECK(std::abs(results.context.continuous_state()[1] - std::exp(-3.0)) < 1e-9);
}

TEST_CASE("an inlined right-hand side that reads its own state through a wire", "[inlined]") {
  DiagramBuilder builder;
  auto& leaf = builder.add<Leaf>("self", [](Leaf& l) {
    l.declare_input_port({.name = "u"});
    const auto ode = [](const Leaf::At& at, Leaf::VectorRef xdot) { xdot[0] = -at.u(0); };
    l.declare_continuous_state({.initial = vec({1.0}), .ode = inlined<1>(ode)});
    l.declare_continuous_state_output("y");
  });
  builder.connect(leaf.output("y"), leaf.input("u"));
  const Diagram diagram = builder.build();
  const Results results =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.rtol = 1e-10, .atol = 1e-12});
  CHECK(std::abs(results.context.continuous_state()[0] - std::exp(-1.0)) < 1e-9);
}

TEST_CASE("what an inlined right-hand side throws, or does not compute, is said", "[inlined]") {
  const auto leaf_of = [](auto ode) {
    return Leaf("late", [ode](Leaf& l) {
      l.declare_continuous_state({.initial = vec({0.0}), .ode = inlined<1>(ode)});
    });
  };
  const Leaf throws = leaf_of([](const Leaf::At& at, Leaf::VectorRef xdot) {
    if (at.time > 0.5) throw std::out_of_range("no table beyond 0.5 s");
    xdot[0] = 1.0;
  });
  CHECK_THROWS_AS(simulate(throws, throws.create_context(), {0.0, 1.0}), std::out_of_range);
  const Leaf nan = leaf_of([](const Leaf::At& at, Leaf::VectorRef xdot) {
    xdot[0] = at.time > 0.5 ? not_a_number : 1.0;
  });
  const std::string said =
      message<SimulationError>([&] { simulate(nan, nan.create_context(), {0.0, 1.0}); });
  CHECK(contains(said, "block 'late' is not finite"));
}

TEST_CASE("a right-hand side inlined for another number of states is refused", "[inlined]") {
  const std::string said = message<ModelError>([] {
    Leaf("pair", [](Leaf& l) {
      l.declare_continuous_state(
          2, inlined<3>([](const Leaf::At&, Leaf::VectorRef xdot) { xdot.setZero(); }));
    });
  });
  CHECK(contains(said, "inlined for 3 continuous states, the block has 2"));
}
