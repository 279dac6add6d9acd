// Right-hand sides compiled together with the steps: the same runs as the plain declaration.
#include "saltus/solver/inlined.hpp"

#include "saltus/simulation/simulate.hpp"
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// N masses that fall side by side against drag, each a little heavier; the first one bounces.
template <int N, bool Inlined>
class Falling final : public LeafSystem {
 public:
  Falling() : LeafSystem("falling") {
    Eigen::VectorXd start = Eigen::VectorXd::Constant(N, -1.0);
    start[0] = 10.0;
    VectorFunction ode = &Falling::ode;
    if (Inlined) ode = inlined<N>(method<&Falling::ode>);
    declare_continuous_state({.initial = start, .ode = std::move(ode)});
    declare_zero_crossing({.name = "bounce",
                           .guard = method<&Falling::height>,
                           .reset_map = method<&Falling::bounce>,
                           .direction = Direction::positive_then_non_positive});
  }

 private:
  void ode(const At& at, VectorRef xdot) const {
    for (Index i = 0; i < N; ++i) {
      const double v = at.x[(i + 1) % N];
      xdot[i] =
          -1.0 - 0.1 * static_cast<double>(i) - 0.05 * v * std::abs(v) + 0.1 * std::sin(at.time);
    }
  }
  double height(const At& at) const { return at.x[0]; }
  void bounce(const At& at, Next& next) const {
    Eigen::VectorXd x = at.x;
    x[0] = 1.0 + std::abs(x[0]);
    next.set_continuous_state(x);
  }
};

template <int N>
void same_runs(const char* name) {
  const SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = name};
  const Falling<N, true> fast;
  const Falling<N, false> plain;
  const Results a = simulate(fast, fast.create_context(), 8.0, options),
                b = simulate(plain, plain.create_context(), 8.0, options);
  INFO(name << ", " << N << " states");
  CHECK(a.statistics.steps == b.statistics.steps);
  CHECK(a.statistics.right_hand_side_calls == b.statistics.right_hand_side_calls);
  REQUIRE(a.events.times("bounce").size() == b.events.times("bounce").size());
  CHECK(a.events.times("bounce").size() > 3);
  // The same operations in the same order: equal but where a compiler fuses them, a rounding each.
  const Eigen::VectorXd x = a.context.continuous_state(), y = b.context.continuous_state();
  CHECK((x - y).cwiseAbs().maxCoeff() <= 1e5 * eps);
}

}  // namespace

TEST_CASE("an inlined right-hand side: the same steps, calls, events and states", "[inlined]") {
  for (const char* name : methods) {
    same_runs<1>(name);
    same_runs<2>(name);
    same_runs<3>(name);
    same_runs<4>(name);
    same_runs<7>(name);
  }
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
  const auto diagram = builder.build();
  const Results results =
      simulate(*diagram, diagram->create_context(), 1.0, {.rtol = 1e-10, .atol = 1e-12});
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
  const auto diagram = builder.build();
  const Results results =
      simulate(*diagram, diagram->create_context(), 1.0, {.rtol = 1e-10, .atol = 1e-12});
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
  CHECK_THROWS_AS(simulate(throws, throws.create_context(), 1.0), std::out_of_range);
  const Leaf nan = leaf_of([](const Leaf::At& at, Leaf::VectorRef xdot) {
    xdot[0] = at.time > 0.5 ? not_a_number : 1.0;
  });
  const std::string said =
      message<SimulationError>([&] { simulate(nan, nan.create_context(), 1.0); });
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
