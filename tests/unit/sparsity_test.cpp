// Which state reaches which derivative: never a place too few, and few too many.
#include "saltus/plan/detail/sparsity.hpp"

#include "saltus/library/library.hpp"
#include "saltus/models/brusselator.hpp"
#include "saltus/models/heat_rod.hpp"
#include "saltus/plan/detail/machine.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

bool has_place(const JacobianPattern& pattern, Index row, Index column) {
  const auto rows = pattern.places.column(column);
  return std::ranges::find(rows, static_cast<int>(row)) != rows.end();
}

/// Every entry of d(xdot)/d(x), by differences of one state each at a point without symmetry, is
/// zero outside the pattern. Exactly so: where a state does not reach, the call is the same.
void nothing_is_missed(const System& system) {
  Machine machine(compile(system));
  machine.load(system.create_context());
  machine.evaluate_instant(0.0);
  const Index n = machine.plan().nx;
  const JacobianPattern pattern = jacobian_pattern(machine.plan());
  REQUIRE(!pattern.overflow);
  REQUIRE(pattern.places.columns() == n);
  Eigen::VectorXd x(n), f(n), moved(n);
  for (Index i = 0; i < n; ++i) x[i] = 1.0 + 0.1 * std::sin(static_cast<double>(3 * i + 1));
  machine.flow(0.25, x.data(), f.data());
  for (Index j = 0; j < n; ++j) {
    Eigen::VectorXd other = x;
    other[j] += 0.5;
    machine.flow(0.25, other.data(), moved.data());
    for (Index i = 0; i < n; ++i) {
      INFO("d xdot[" << i << "] / d x[" << j << "]");
      CHECK((moved[i] == f[i] || has_place(pattern, i, j)));
    }
  }
}

JacobianPattern pattern_of(const System& system) { return jacobian_pattern(*compile(system)); }

/// x_i' = x_{i+1} - 2 x_i + x_{i-1}, each with blocks of its own.
Diagram scalar_chain(int n) {
  DiagramBuilder builder;
  std::vector<Integrator*> states;
  for (int i = 0; i < n; ++i) {
    IntegratorOptions options;
    options.initial_state = 1.0;
    states.push_back(&builder.add<Integrator>(text("x", i), options));
  }
  auto& wall = builder.add<Constant>("wall", 0.0);
  for (int i = 0; i < n; ++i) {
    auto& sum = builder.add<Adder>(text("sum", i), "++-");
    auto& twice = builder.add<Gain>(text("twice", i), 2.0);
    const auto at = [&](int k) {
      return k < 0 || k >= n ? wall.output() : states[static_cast<std::size_t>(k)]->output();
    };
    builder.connect(at(i), twice.input());
    builder.connect(at(i - 1), sum.input(0)), builder.connect(at(i + 1), sum.input(1));
    builder.connect(twice.output(), sum.input(2));
    builder.connect(sum.output(), states[static_cast<std::size_t>(i)]->input());
  }
  return builder.build();
}

}  // namespace

TEST_CASE("a chain of scalar blocks is tridiagonal", "[sparsity]") {
  const Diagram chain = scalar_chain(7);
  nothing_is_missed(chain);
  const JacobianPattern pattern = pattern_of(chain);
  CHECK(pattern.places.size() == 3 * 7 - 2);
  CHECK(pattern.own.empty());
}

TEST_CASE("elementwise blocks keep the entries of a vector apart", "[sparsity]") {
  DiagramBuilder builder;
  IntegratorOptions options;
  options.initial_state = Eigen::VectorXd::Ones(5);
  auto& u = builder.add<Integrator>("u", options);
  auto& v = builder.add<Integrator>("v", options);
  auto& product = builder.add<Product>("product", "**");
  auto& gain = builder.add<Gain>("gain", -2.0);
  auto& sine = builder.add<FunctionBlock>("sine", [](double x) { return std::sin(x); });
  builder.connect(u.output(), product.input(0)), builder.connect(v.output(), product.input(1));
  builder.connect(product.output(), gain.input()), builder.connect(gain.output(), u.input());
  builder.connect(u.output(), sine.input()), builder.connect(sine.output(), v.input());
  const Diagram diagram = builder.build();
  nothing_is_missed(diagram);
  // u_i' reads u_i and v_i; v_i' reads u_i, and its diagonal is kept.
  CHECK(pattern_of(diagram).places.size() == 4 * 5);
}

TEST_CASE("what is cut and joined keeps its places", "[sparsity]") {
  DiagramBuilder builder;
  IntegratorOptions options;
  options.initial_state = Eigen::VectorXd::Ones(6);
  auto& x = builder.add<Integrator>("x", options);
  auto& cut = builder.add<Demultiplexer>("cut", 3);
  auto& join = builder.add<Multiplexer>("join", 3);
  builder.connect(x.output(), cut.input());
  for (int k = 0; k < 3; ++k) builder.connect(cut.output(k), join.input((k + 1) % 3));
  builder.connect(join.output(), x.input());
  const Diagram diagram = builder.build();
  nothing_is_missed(diagram);
  const JacobianPattern pattern = pattern_of(diagram);
  CHECK(pattern.places.size() == 12);
  CHECK(has_place(pattern, 2, 0));  // part 0 of x arrives as part 1
}

TEST_CASE("a function over whole signals is dense, a held value passes nothing on", "[sparsity]") {
  DiagramBuilder builder;
  IntegratorOptions options;
  options.initial_state = Eigen::VectorXd::Ones(4);
  auto& x = builder.add<Integrator>("x", options);
  auto& y = builder.add<Integrator>("y");
  auto& sum = builder.add<ReduceBlock>("sum", 1, [](const Inputs& u) { return u[0].sum(); });
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.1);
  auto& mix = builder.add<ReduceBlock>(
      "mix", 1, [](const Inputs& u) { return Eigen::VectorXd(u[0].reverse() * u[0].sum()); },
      ReduceBlock::Options{.shape = Shape::of(4)});
  builder.connect(x.output(), mix.input()), builder.connect(mix.output(), x.input());
  builder.connect(x.output(), sum.input()), builder.connect(sum.output(), hold.input());
  builder.connect(hold.output(), y.input());
  const Diagram diagram = builder.build();
  nothing_is_missed(diagram);
  CHECK(pattern_of(diagram).places.size() == 4 * 4 + 1);
}

TEST_CASE("a leaf is dense unless it declares otherwise", "[sparsity]") {
  const auto leaf = [](bool declared) {
    return Leaf("leaf", [declared](Leaf& l) {
      l.declare_continuous_state(5, [](const At& at, VectorRef xdot) {
        for (Index i = 0; i < 5; ++i) xdot[i] = i > 0 ? at.x[i] * at.x[i - 1] : at.x[0];
      });
      if (declared) l.declare_jacobian_sparsity(band_entries(5, 1, 0));
    });
  };
  nothing_is_missed(leaf(false)), nothing_is_missed(leaf(true));
  CHECK(pattern_of(leaf(false)).places.size() == 25);
  CHECK(pattern_of(leaf(true)).places.size() == 9);
}

TEST_CASE("the scenes that declare a band read no more than that", "[sparsity]") {
  for (const Index n : {1, 2, 3, 9}) {
    nothing_is_missed(models::Brusselator(n));
    nothing_is_missed(models::HeatRod({.n = n}));
  }
}

TEST_CASE("a leaf's own Jacobian serves its block unless its input leads back to it",
          "[sparsity]") {
  const auto system = [](bool loop) {
    DiagramBuilder builder;
    auto& leaf = builder.add<Leaf>("leaf", [](Leaf& l) {
      l.declare_input_port({.name = "in", .shape = Shape::scalar()});
      l.declare_continuous_state(
          {.initial = vec({1.0, 2.0}),
           .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], at.u(0); },
           .jacobian = [](const At&, MatrixRef j) { j << 0.0, 1.0, 0.0, 0.0; }});
      l.declare_continuous_state_output("x");
    });
    auto& other = builder.add<Integrator>("other", IntegratorOptions{.initial_state = 1.0});
    auto& sum = builder.add<ReduceBlock>("sum", 1, [](const Inputs& u) { return u[0].sum(); });
    builder.connect(leaf.output(), sum.input()), builder.connect(sum.output(), other.input());
    builder.connect(loop ? sum.output() : other.output(), leaf.input());
    return builder.build();
  };
  nothing_is_missed(system(false)), nothing_is_missed(system(true));
  CHECK(pattern_of(system(false)).own.size() == 1);
  CHECK(pattern_of(system(true)).own.empty());
}

TEST_CASE("a sparsity that cannot be is refused", "[sparsity][errors]") {
  const auto refusal = [](std::vector<MatrixEntry> entries) {
    const Leaf leaf("leaf", [&](Leaf& l) {
      l.declare_continuous_state(2, [](const At& at, VectorRef xdot) { xdot = at.x; });
      l.declare_jacobian_sparsity(entries);
    });
    return message<ModelError>([&] { pattern_of(leaf); });
  };
  CHECK(contains(refusal({{0, 2}}), "block 'leaf'"));
  CHECK(contains(refusal({{0, 2}}), "names entry (0, 2); the block has 2 continuous states"));
  CHECK(contains(refusal({{-1, 0}}), "names entry (-1, 0)"));
  CHECK(contains(refusal({{1, 0}, {0, 0}, {1, 0}}), "names entry (1, 0) twice"));
}

TEST_CASE("ten thousand states that all meet overflow without the memory for it", "[sparsity]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(10'000, [](const At& at, VectorRef xdot) { xdot = -at.x; });
  });
  CHECK(pattern_of(leaf).overflow);
  CHECK(pattern_of(leaf).places.size() == 0);
}
