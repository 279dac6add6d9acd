// Every linear solver gives the same trajectory; the choice fits the scene and says why.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

const std::vector<LinearSolver> solvers{LinearSolver::dense, LinearSolver::band,
                                        LinearSolver::sparse, LinearSolver::gmres,
                                        LinearSolver::automatic};

/// u_t = 1 + u^2 v - 4 u + c u_xx, v_t = 3 u - u^2 v + c v_xx, u and v in turn, ends held at (1,
/// 3).
void brusselator(const At& at, VectorRef xdot) {
  const Index n = xdot.size();
  const double c = 0.02 * static_cast<double>((n / 2 + 1) * (n / 2 + 1));
  for (Index i = 0; i < n; i += 2) {
    const double u = at.x[i], v = at.x[i + 1], uuv = u * u * v;
    const double lu = i > 0 ? at.x[i - 2] : 1.0, lv = i > 0 ? at.x[i - 1] : 3.0;
    const double ru = i < n - 2 ? at.x[i + 2] : 1.0, rv = i < n - 2 ? at.x[i + 3] : 3.0;
    xdot[i] = 1.0 + uuv - 4.0 * u + c * (lu - 2.0 * u + ru);
    xdot[i + 1] = 3.0 * u - uuv + c * (lv - 2.0 * v + rv);
  }
}

/// With the sparsity that it has, or as a block of which nothing is known.
Leaf brusselator_leaf(Index n, bool declared) {
  return Leaf("brusselator", [=](Leaf& l) {
    Eigen::VectorXd start(n);
    for (Index i = 0; i < n; ++i)
      start[i] = i % 2 == 1 ? 3.0
                            : 1.0 + std::sin(6.283185307 * static_cast<double>(i + 2) /
                                             static_cast<double>(n + 2));
    l.declare_continuous_state({.initial = start, .ode = brusselator});
    if (declared) l.declare_jacobian_sparsity(band_entries(n, 2, 2));
  });
}

/// Heat on a square of m by m points, edges at 0: x_t = laplacian x.
Leaf heat(Index m, bool own_jacobian) {
  return Leaf("heat", [=](Leaf& l) {
    std::vector<MatrixEntry> entries;
    for (Index k = 0; k < m * m; ++k) {
      entries.push_back({k, k});
      if (k % m > 0) entries.push_back({k - 1, k});
      if (k % m < m - 1) entries.push_back({k + 1, k});
      if (k >= m) entries.push_back({k - m, k});
      if (k < m * m - m) entries.push_back({k + m, k});
    }
    const double c = static_cast<double>((m + 1) * (m + 1));
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(m * m), .ode = [=](const At& at, VectorRef xdot) {
           for (Index k = 0; k < m * m; ++k) {
             double sum = -4.0 * at.x[k];
             if (k % m > 0) sum += at.x[k - 1];
             if (k % m < m - 1) sum += at.x[k + 1];
             if (k >= m) sum += at.x[k - m];
             if (k < m * m - m) sum += at.x[k + m];
             xdot[k] = c * sum;
           }
         }});
    if (!own_jacobian) return l.declare_jacobian_sparsity(entries);
    l.declare_sparse_jacobian(entries, [=](const At&, VectorRef out) {
      for (std::size_t k = 0; k < entries.size(); ++k)
        out[static_cast<Index>(k)] = entries[k].row == entries[k].column ? -4.0 * c : c;
    });
  });
}

Results run(const System& system, double t_end, LinearSolver solver, double rtol = 1e-7,
            Method method = Method::bdf) {
  return simulate(
      system, system.create_context(), {0.0, t_end},
      {.rtol = rtol, .atol = rtol, .ode_solver_method = method, .linear_solver = solver});
}

/// Radau's matrices, one real and some complex, are solved by the same solvers.
void radau_agrees(const System& system, double t_end, LinearSolver solver,
                  const Eigen::VectorXd& exact) {
  const Results results = run(system, t_end, solver, 1e-7, Method::radau);
  CHECK((results.context.continuous_state() - exact).cwiseAbs().maxCoeff() < 10e-7);
  CHECK(results.statistics.linear_setups > 0);
}

/// All solvers end where a run at a hundredth of the tolerance ends. BDF's global error on these
/// two, whose flow contracts or is mild, stays within the sum of local errors, one tolerance each
/// step, a few hundred steps; that of Radau within ten.
void all_agree(const System& system, double t_end) {
  const Eigen::VectorXd exact =
      run(system, t_end, LinearSolver::dense, 1e-9).context.continuous_state();
  for (const LinearSolver solver : solvers) {
    INFO("linear solver " << solver);
    const Results results = run(system, t_end, solver);
    CHECK((results.context.continuous_state() - exact).cwiseAbs().maxCoeff() < 300e-7);
    const bool chosen = solver == LinearSolver::automatic;
    CHECK((chosen ||
           results.statistics.linear_solver.starts_with(text(to_string(solver), ": n = "))));
    CHECK(chosen != contains(results.statistics.linear_solver, "asked for"));
    if (solver != LinearSolver::gmres) radau_agrees(system, t_end, solver, exact);
  }
}

std::string chosen(const System& system) {
  return run(system, 1e-3, LinearSolver::automatic, 1e-3).statistics.linear_solver;
}

/// x_0 pulls at all others, and they at it: no order of the states makes that a band.
Leaf star(Index n) {
  return Leaf("star", [=](Leaf& l) {
    std::vector<MatrixEntry> entries{{0, 0}};
    for (Index i = 1; i < n; ++i)
      for (const MatrixEntry& entry : {MatrixEntry{i, i}, MatrixEntry{i, 0}, MatrixEntry{0, i}})
        entries.push_back(entry);
    l.declare_continuous_state({.initial = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0),
                                .ode = [n](const At& at, VectorRef xdot) {
                                  xdot = Eigen::VectorXd::Constant(n, at.x[0]) - at.x;
                                  xdot[0] = at.x.sum() - static_cast<double>(n) * at.x[0];
                                }});
    l.declare_sparse_jacobian(entries, [n](const At&, VectorRef out) {
      out[0] = 1.0 - static_cast<double>(n);
      for (Index i = 1; i < n; ++i) out.segment<3>(3 * i - 2) << -1.0, 1.0, 1.0;
    });
  });
}

/// n scalar integrators, each pulled to its neighbours in a shuffled order: a band, well hidden.
Diagram hidden_band(int n) {
  DiagramBuilder builder;
  std::vector<Integrator*> x;
  const auto at = [&](int i) { return x[static_cast<std::size_t>((i * 7) % n)]; };
  for (int i = 0; i < n; ++i)
    x.push_back(&builder.add<Integrator>(text("x", i), IntegratorOptions{.initial_state = 1.0}));
  for (int i = 0; i < n; ++i) {
    auto& pull = builder.add<Adder>(text("pull", i), i + 1 < n ? "+--" : "--");
    int port = 0;
    if (i + 1 < n) builder.connect(at(i + 1)->output(), pull.input(port++));
    builder.connect(at(i)->output(), pull.input(port++));
    builder.connect(at(i)->output(), pull.input(port));
    builder.connect(pull.output(), at(i)->input());
  }
  return builder.build();
}

}  // namespace

TEST_CASE("every linear solver gives the same trajectory", "[linear]") {
  all_agree(brusselator_leaf(60, true), 2.0);
  all_agree(brusselator_leaf(60, false), 2.0);
  all_agree(heat(9, false), 0.1);
  all_agree(heat(9, true), 0.1);
  all_agree(hidden_band(50), 3.0);
  all_agree(star(30), 2.0);
}

TEST_CASE("the choice fits the scene and says why", "[linear]") {
  const Leaf small("small", [](Leaf& l) {
    l.declare_continuous_state(3, [](const At& at, VectorRef xdot) { xdot = -at.x; });
  });
  CHECK(chosen(small) == "dense: n = 3, 9 places, 3 colours; few states");
  CHECK(chosen(brusselator_leaf(1000, true)) ==
        "band: n = 1000, 4994 places, 5 colours, band 2 + 1 + 2; the band is narrow");
  CHECK(chosen(brusselator_leaf(60, false)).starts_with("dense: n = 60, 3600 places, 60 colours"));
  const std::string hidden = chosen(hidden_band(200));
  INFO(hidden);
  CHECK(hidden.starts_with("band: n = 200, 399 places"));
  CHECK(contains(hidden, "after reordering"));
  const std::string square = chosen(heat(60, true));
  INFO(square);
  CHECK(square.starts_with("band: n = 3600, 17760 places, none by differences, band 60 + 1 + 60"));
  const std::string large = chosen(heat(150, true));
  INFO(large);
  CHECK(large.starts_with("gmres: n = 22500, 111900 places, none by differences; factors would"));
  const std::string hub = chosen(star(500));
  INFO(hub);
  CHECK(hub.starts_with("sparse: n = 500, 1498 places, none by differences"));
}

TEST_CASE("a pattern that is not to be looked for is left to GMRES, which says what would help",
          "[linear]") {
  const Leaf leaf = brusselator_leaf(4000, false);
  const std::string choice =
      simulate(leaf, leaf.create_context(), {0.0, 1e-3},
               {.rtol = 1e-3, .ode_solver_method = Method::bdf, .find_sparsity = false})
          .statistics.linear_solver;
  INFO(choice);
  CHECK(choice.starts_with("gmres: n = 4000"));
  CHECK(contains(choice, "declare the sparsity"));
}

TEST_CASE("describe() tells the linear solver once it exists", "[linear]") {
  const Leaf leaf = brusselator_leaf(20, true);
  Simulator simulator(leaf, {.ode_solver_method = Method::bdf});
  simulator.initialize(leaf.create_context());
  CHECK(!contains(simulator.describe(), "linear solver"));
  simulator.advance_to(0.1);
  CHECK(contains(simulator.describe(), "linear solver: "));
  CHECK(contains(simulator.describe(), "n = 20"));
}

TEST_CASE("BDF with differences costs as many calls as there are colours", "[linear]") {
  const Results results = run(brusselator_leaf(400, true), 10.0, LinearSolver::automatic);
  const Statistics& s = results.statistics;
  CHECK(s.jacobian_calls > 0);
  // Newton takes at most three evaluations an attempt, and one more begins the run and each retry.
  CHECK(s.right_hand_side_calls <= 5 * s.jacobian_calls + 3 * (s.steps + s.rejected) + 10);
}

/// CVODE takes a residual that GMRES only reduced for a solution; such a correction is too small,
/// and Newton's test, which looks at its size, passes: the first sine of a rod of 2001 points fell
/// behind by 4.7 tolerances within 0.01 s, and at 0.1 s 0.222 stood in place of 0.373.
TEST_CASE("GMRES that does not converge is no solution", "[linear]") {
  constexpr Index n = 2001;  // whose places are unknown, so there is no preconditioner
  static constexpr double c = (n + 1.0) * (n + 1.0), pi = 3.14159265358979324;
  const Leaf rod("rod", [&](Leaf& l) {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1.0, n) * (pi / (n + 1));
    l.declare_continuous_state(
        {.initial = x.array().sin(), .ode = [](const At& at, VectorRef xdot) {
           const Index m = xdot.size() - 1;
           xdot = -2.0 * at.x;
           xdot.head(m) += at.x.tail(m);
           xdot.tail(m) += at.x.head(m);
           xdot *= c;
         }});
  });
  constexpr double rtol = 1e-4, t = 0.01;
  const Results results = simulate(rod, rod.create_context(), {0.0, t},
                                   {.rtol = rtol,
                                    .atol = 1e-2 * rtol,
                                    .ode_solver_method = Method::bdf,
                                    .find_sparsity = false});
  CHECK(results.statistics.linear_solver.starts_with("gmres"));
  // The sine is an eigenvector and decays at -4 c sin^2(pi / (2 (n + 1))), by a tenth in all. Where
  // systems are solved five steps do for that, each with a local error up to rtol; far fewer than
  // half of those add up.
  const double half = std::sin(0.5 * pi / (n + 1)), rate = 4.0 * c * half * half;
  CHECK_THAT(results.context.continuous_state()[n / 2], WithinAbs(std::exp(-rate * t), 2.0 * rtol));
}

namespace {

/// 2001 states, whose places are unknown, that decay at `count` rates, evenly from 1/s to 1e4/s in
/// logarithm.
Leaf decays(int count) {
  return Leaf("decays", [=](Leaf& l) {
    Eigen::VectorXd rates(2001);
    for (Index i = 0; i < rates.size(); ++i)
      rates[i] = std::pow(10.0, 4.0 * static_cast<double>(i % count) / (count - 1));
    l.declare_continuous_state(
        {.initial = Eigen::VectorXd::Ones(rates.size()),
         .ode = [=](const At& at, VectorRef xdot) { xdot = -rates.cwiseProduct(at.x); }});
  });
}

}  // namespace

// On a diagonal matrix with k different entries GMRES ends after k vectors (Y. Saad, Iterative
// Methods for Sparse Linear Systems, 2nd ed., proposition 6.10). With 8 and with 19 rates twenty
// vectors are enough, so accuracy alone decides on the steps: of both the slowest and the fastest
// rates are equal. With 300 rates twenty are too few for a long step, and CVODE shortens it; the
// memory of more vectors is not taken.
TEST_CASE("GMRES has twenty vectors: as many rates cost no steps, many more do", "[linear]") {
  const auto steps = [](int count) {
    const Leaf leaf = decays(count);
    return static_cast<double>(
        simulate(
            leaf, leaf.create_context(), {0.0, 1.0},
            {.rtol = 1e-4, .atol = 1e-4, .ode_solver_method = Method::bdf, .find_sparsity = false})
            .statistics.steps);
  };
  const double few = steps(8);
  CHECK(steps(19) < 1.1 * few);
  CHECK(steps(300) > 1.1 * few);
}
