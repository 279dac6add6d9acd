// What goes wrong around Jacobians and linear solvers says what it is, or does no harm.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

const std::vector<LinearSolver> solvers{LinearSolver::dense, LinearSolver::band,
                                        LinearSolver::sparse, LinearSolver::gmres};

/// x_i' = -(i + 1) x_i for n states, with this sparse Jacobian of its diagonal.
Leaf decays(Index n, VectorFunction values) {
  return Leaf("decays", [&](Leaf& l) {
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(n), .ode = [n](const At& at, VectorRef xdot) {
           for (Index i = 0; i < n; ++i) xdot[i] = -static_cast<double>(i + 1) * at.x[i];
         }});
    l.declare_sparse_jacobian(band_entries(n, 0, 0), std::move(values));
  });
}

/// The method for a test of this solver: Radau does not take all of them.
Method method_with(LinearSolver solver, Method method) {
  return solver == LinearSolver::gmres ? Method::bdf : method;
}

std::string failure(const System& system, LinearSolver solver) {
  return message<SimulationError>([&] {
    simulate(system, system.create_context(), {0.0, 2.0},
             {.ode_solver_method = Method::bdf, .linear_solver = solver});
  });
}

struct Thrown {
  int number;
};

}  // namespace

TEST_CASE("differences stand in for a sparse Jacobian that is not finite", "[errors][linear]") {
  const auto solver = GENERATE(from_range(solvers));
  const auto method = method_with(solver, GENERATE(Method::bdf, Method::radau));
  INFO(method << ", " << solver);
  const auto run = [&](double factor) {
    const Leaf leaf = decays(20, [factor](const At&, VectorRef out) {
      for (Index i = 0; i < 20; ++i) out[i] = -factor * static_cast<double>(i + 1);
    });
    return simulate(leaf, leaf.create_context(), {0.0, 2.0},
                    {.ode_solver_method = method, .linear_solver = solver});
  };
  const Results well = run(1.0), mended = run(not_a_number);
  CHECK(!contains(well.statistics.linear_solver, "not finite"));
  CHECK(contains(mended.statistics.linear_solver,
                 "entry (0, 0) of the Jacobian of block 'decays' was not finite at t = "));
  // Newton's iteration converges to the same states; what it leaves is below a tolerance a step,
  // and a hundred steps of a flow that contracts leave less than a hundred tolerances.
  CHECK(
      (mended.context.continuous_state() - well.context.continuous_state()).cwiseAbs().maxCoeff() <
      100.0 * (1e-6 + 1e-8));
}

TEST_CASE("what a Jacobian throws comes out as it was", "[errors][linear]") {
  const auto solver = GENERATE(from_range(solvers));
  const auto method = method_with(solver, GENERATE(Method::bdf, Method::radau));
  INFO(method << ", " << solver);
  const Leaf leaf = decays(20, [](const At&, VectorRef) { throw Thrown{17}; });
  try {
    simulate(leaf, leaf.create_context(), {0.0, 2.0},
             {.ode_solver_method = method, .linear_solver = solver});
    FAIL("nothing was thrown");
  } catch (const Thrown& thrown) {
    CHECK(thrown.number == 17);
  }
}

TEST_CASE("a dense Jacobian with values outside its declared sparsity is refused",
          "[errors][linear]") {
  const Leaf leaf("leaf", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 2.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; },
         .jacobian = [](const At&, MatrixRef j) { j << 0.0, 1.0, -1.0, 0.0; }});
    l.declare_jacobian_sparsity({{0, 1}});
  });
  const std::string what = failure(leaf, LinearSolver::automatic);
  INFO(what);
  CHECK(contains(what, "block 'leaf' has values outside the sparsity"));
}

TEST_CASE("a matrix that is singular at some step size is a shorter step, not an end",
          "[errors][linear]") {
  // I - gamma J is singular where gamma = 1/lambda: an exploding state with a Jacobian that claims
  // to explode at whatever gamma is. Whatever is claimed, the answer is right: x' = x.
  const auto solver = GENERATE(from_range(solvers));
  INFO(solver);
  int calls = 0;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::Ones(12),
                                .ode = [](const At& at, VectorRef xdot) { xdot = at.x; }});
    // Two equal rows with 1/gamma on top would need gamma; a column of huge equal numbers does for
    // any: I - gamma J rounds to two proportional rows.
    l.declare_jacobian([&](const At&, MatrixRef j) {
      j.setIdentity();
      if (calls++ == 0) j.row(0).setConstant(1e300), j.row(1).setConstant(1e300);
    });
  });
  const Results results = simulate(leaf, leaf.create_context(), {0.0, 1.0},
                                   {.ode_solver_method = Method::bdf, .linear_solver = solver});
  CHECK(calls > 1);
  // Growth e, rtol 1e-6, some 50 steps.
  CHECK(std::abs(results.context.continuous_state()[0] - std::exp(1.0)) < 50 * 2.72 * 2e-6);
}

TEST_CASE("a Jacobian that is far off costs steps, not digits", "[errors][linear]") {
  const Leaf leaf = decays(20, [](const At&, VectorRef out) { out.setConstant(-5.0); });
  const Results results =
      simulate(leaf, leaf.create_context(), {0.0, 1.0},
               {.ode_solver_method = Method::bdf, .linear_solver = LinearSolver::band});
  for (Index i = 0; i < 20; ++i)
    CHECK(std::abs(results.context.continuous_state()[i] - std::exp(-static_cast<double>(i + 1))) <
          1e-4);
}

TEST_CASE("an unknown linear solver, or one for a method without, is refused", "[errors][linear]") {
  const Leaf leaf = decays(2, [](const At&, VectorRef out) { out << -1.0, -2.0; });
  CHECK(contains(message<ModelError>([] { linear_solver_from("bnad"); }),
                 "unknown linear_solver 'bnad'; did you mean 'band'?"));
  const std::string unused = message<ModelError>([&] {
    Simulator(leaf, {.ode_solver_method = Method::dopri5, .linear_solver = LinearSolver::band});
  });
  INFO(unused);
  CHECK(contains(unused, "ode_solver_method 'dopri5' solves no linear systems"));
}
