// The Radau methods: their coefficients, their decisions, and their orders.
#include "saltus/solver/detail/radau/convergence.hpp"
#include "saltus/solver/detail/radau/stage_polynomial.hpp"
#include "saltus/solver/detail/radau/step_control.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// x'' = -x from (1, 0): x = cos t. It is linear, so that Newton's iteration is exact.
Leaf oscillator(double level) {
  return Leaf("oscillator", [level](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
    l.declare_continuous_state_output("x");
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [level](const At& at) { return at.x[0] - level; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.x[0], at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

/// A run with steps of h. The tolerance is so loose that no step is rejected; at most nine steps are
/// taken, so that the order stays five.
Results run(double h, double level, std::vector<double> save_at = {}) {
  const Leaf leaf = oscillator(level);
  return simulate(leaf, leaf.create_context(), {0.0, 2.0},
                  {.rtol = 1e-2,
                   .atol = 1e-2,
                   .ode_solver_method = Method::radau,
                   .max_minor_step_size = h,
                   .first_step = h,
                   .recorded_signals = {{"x", leaf.output(0)}},
                   .save_at = std::move(save_at)});
}

template <int S>
void check_coefficients() {
  using T = RadauTable<S>;
  INFO(S << " stages");
  double sum;
  for (int k = 1; k <= 2 * S - 1; ++k) {
    // B(2S - 1): the last row of A integrates t^(k-1) up to k = 2S - 1, the order.
    sum = 0.0;
    for (int j = 0; j < S; ++j) sum += T::a[S - 1][j] * std::pow(T::c[j], k - 1);
    CHECK_THAT(sum, WithinAbs(1.0 / k, 20.0 * eps));
    // C(S): all rows do up to k = S.
    for (int i = 0; i < S && k <= S; ++i) {
      sum = 0.0;
      for (int j = 0; j < S; ++j) sum += T::a[i][j] * std::pow(T::c[j], k - 1);
      CHECK_THAT(sum, WithinAbs(std::pow(T::c[i], k) / k, 20.0 * eps));
    }
    // The error estimate of x = t^k, x0 = 0, is zero up to k = S: h f0 + sum_j e_j z_j.
    sum = k == 1 ? 1.0 : 0.0;
    for (int j = 0; j < S; ++j) sum += T::e[j] * std::pow(T::c[j], k);
    if (k <= S) CHECK_THAT(sum, WithinAbs(0.0, 1000.0 * eps));
    if (k == S + 1) CHECK(std::abs(sum) > 1e-4);
  }
  // A T Lambda = T, with Lambda made of gamma and the blocks [alpha -beta; beta alpha].
  Eigen::Matrix<double, S, S> a, t, t_inverse, lambda = Eigen::Matrix<double, S, S>::Zero();
  for (int i = 0; i < S; ++i) {
    for (int j = 0; j < S; ++j)
      a(i, j) = T::a[i][j], t(i, j) = T::t[i][j], t_inverse(i, j) = T::t_inverse[i][j];
  }
  lambda(0, 0) = T::gamma;
  for (int k = 0; k < (S - 1) / 2; ++k) {
    const int re = 2 * k + 1, im = re + 1;
    lambda(re, re) = lambda(im, im) = T::alpha[k];
    lambda(im, re) = T::beta[k], lambda(re, im) = -T::beta[k];
  }
  // Entries of T^-1 are up to 300 for seven stages.
  CHECK((a * t * lambda - t).cwiseAbs().maxCoeff() < 1e3 * eps);
  CHECK((t * t_inverse - a.Identity()).cwiseAbs().maxCoeff() < 1e4 * eps);
}

}  // namespace

TEST_CASE("the coefficients satisfy the conditions of order 2 S - 1, and the estimate those of S",
          "[radau]") {
  check_coefficients<3>();
  check_coefficients<5>();
  check_coefficients<7>();
}

TEST_CASE("the stage polynomial is exact for polynomials, and predicts them", "[radau]") {
  const int stages = GENERATE(3, 5, 7), to = GENERATE(3, 5, 7);
  const radau::Scheme here = radau::scheme_of(stages), there = radau::scheme_of(to);
  const auto x = [stages](double s) { return std::pow(s, stages) - 0.5 * s; };
  radau::StagePolynomial polynomial(1);
  polynomial.stages = stages;
  for (int j = 0; j < stages; ++j) polynomial.z(0, j) = x(here.c[j]);
  const double x0 = 0.0;
  for (const double s : {0.0, 0.3, here.c[0], 1.0, 1.4}) {
    double read = 0.0;
    polynomial.read(&x0, s, &read);
    CHECK_THAT(read, WithinAbs(x(s), 1e-10));  // s = 1.4 enlarges roundings by 1e5
  }
  Eigen::MatrixXd next(1, radau::most_stages);
  polynomial.predict(to, 1.0, 0.5, next);
  for (int i = 0; i < to; ++i)
    CHECK_THAT(next(0, i), WithinAbs(x(1.0 + 0.5 * there.c[i]) - x(1.0), 1e-10));
}

TEST_CASE("Newton's iteration is judged by how its corrections shrink", "[radau]") {
  using radau::Convergence, radau::Verdict;
  // Tolerance 0.1, rounding 1e-8, seven iterations, nothing known before.
  const auto verdicts = [](std::vector<double> corrections, double before = infinite) {
    Convergence convergence(0.1, 1e-8, 7, before);
    std::vector<Verdict> all;
    for (const double each : corrections) all.push_back(convergence.look(each));
    return all;
  };
  using V = std::vector<Verdict>;
  // The first correction says nothing by itself, unless it is zero.
  CHECK(verdicts({1e-3}) == V{Verdict::go_on});
  CHECK(verdicts({0.0}) == V{Verdict::converged});
  // A contraction known from before counts, but as 0.01^0.8 = 0.025 at least.
  CHECK(verdicts({3.0}, 0.0) == V{Verdict::converged});
  CHECK(verdicts({5.0}, 0.0) == V{Verdict::go_on});
  // theta = 0.1: 0.1 / 0.9 of the last correction is left.
  CHECK(verdicts({10.0, 1.0, 0.1}) == V{Verdict::go_on, Verdict::go_on, Verdict::converged});
  // theta = 0.9 would leave too much after seven iterations; growing corrections diverge.
  CHECK(verdicts({10.0, 9.0}) == V{Verdict::go_on, Verdict::slow});
  CHECK(verdicts({10.0, 11.0}) == V{Verdict::go_on, Verdict::diverged});
  // A correction below the tolerance that does not shrink is not converged: only rounding excuses it.
  CHECK(verdicts({1e-3, 1e-3}) == V{Verdict::go_on, Verdict::diverged});
  CHECK(verdicts({1e-9, 1e-9}) == V{Verdict::go_on, Verdict::converged});
}

TEST_CASE("the order of the Radau methods follows Newton's iteration", "[radau]") {
  using radau::next_stages;
  CHECK(next_stages({.stages = 3, .theta = 0.001, .ratio = 1.0, .steps = 10}) == 5);
  CHECK(next_stages({.stages = 3, .theta = 0.003, .ratio = 1.0, .steps = 10}) == 3);
  CHECK(next_stages({.stages = 3, .theta = 0.001, .ratio = 1.0, .steps = 9}) == 3);
  CHECK(next_stages({.stages = 3, .theta = 0.001, .ratio = 1.3, .steps = 10}) == 3);
  CHECK(next_stages({.stages = 3, .theta = 0.001, .ratio = 0.7, .steps = 10}) == 3);
  CHECK(next_stages({.stages = 7, .theta = 0.001, .ratio = 1.0, .steps = 10}) == 7);
  CHECK(next_stages({.stages = 7, .theta = 0.8}) == 5);
  CHECK(next_stages({.stages = 5, .newton_failed = true}) == 3);
  CHECK(next_stages({.stages = 3, .newton_failed = true}) == 3);
}

TEST_CASE("the allowed estimate lets a step be as long as its own error allows", "[radau]") {
  // 0.1 rtol^(4/6 - 1) = 0.1 * 100 at 1e-6; at 1e-14 the dense output bounds it: 4 * 2^4 / share.
  const radau::Scheme three = radau::scheme_of(3);
  CHECK_THAT(radau::allowed_estimate(three, 1e-6, 4.0), WithinRel(10.0, 1e-12));
  CHECK_THAT(radau::allowed_estimate(three, 1e-14, 4.0),
             WithinRel(64.0 / three.dense_share, 1e-12));
}

TEST_CASE("steps of three stages have order 5, their dense output order 3 and more", "[radau]") {
  // The error at 2 s, and the largest in between, for 4 and 8 steps.
  std::vector<double> rows;
  for (int i = 1; i < 40; ++i) rows.push_back(0.05 * i + 1e-3);
  double end[2], inside[2] = {0.0, 0.0};
  for (const int k : {0, 1}) {
    const auto results = run(k == 0 ? 0.5 : 0.25, -2.0, rows);
    CHECK(results.statistics.steps == (k == 0 ? 4 : 8));
    end[k] = (results.context.continuous_state() - vec({std::cos(2.0), -std::sin(2.0)})).norm();
    const auto x = results.output("x");
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      const auto row = static_cast<Index>(i);
      inside[k] = std::max(inside[k], std::abs(x(row, 0) - std::cos(results.time[i])));
    }
  }
  CHECK(std::log2(end[0] / end[1]) > 4.7);
  CHECK(std::log2(inside[0] / inside[1]) > 2.7);
  CHECK(end[1] < 0.1 * inside[1]);  // which is why a step that an event cuts is taken again
}

TEST_CASE("an event has the order of the steps, not that of the dense output", "[radau]") {
  // x = cos t falls through 0.35 at 1.213 s, inside the third step of 0.5 and the fifth of 0.25.
  const double level = 0.35, exact = std::acos(level);
  double error[2];
  for (const int k : {0, 1}) {
    const auto results = run(k == 0 ? 0.5 : 0.25, level);
    REQUIRE(results.events.size() == 1);
    error[k] = std::abs(results.events[0].time - exact);
  }
  // A point at a fixed part of a step would have the order 4 of the collocation polynomial.
  CHECK(std::log2(error[0] / error[1]) > 4.5);
}

TEST_CASE("looks inside steps change no bit of them", "[radau]") {
  const Leaf leaf = oscillator(-2.0);
  const auto end = [&](std::vector<double> rows) {
    return simulate(leaf, leaf.create_context(), {0.0, 20.0},
                    {.rtol = 1e-10,
                     .atol = 1e-10,
                     .ode_solver_method = Method::radau,
                     .save_at = std::move(rows)})
        .context.continuous_state();
  };
  std::vector<double> rows;
  for (int i = 1; i < 200; ++i) rows.push_back(0.1 * i);
  CHECK(end({}) == end(rows));
}

TEST_CASE("matrices that cannot be factorised are refused with what to take instead", "[radau]") {
  const Leaf leaf = oscillator(0.0);
  const auto refused = message<ModelError>([&] {
    simulate(leaf, leaf.create_context(), {0.0, 1.0},
             {.ode_solver_method = Method::radau, .linear_solver = LinearSolver::gmres});
  });
  CHECK(contains(refused, "'gmres'"));
  CHECK(contains(refused, "'bdf'"));
}
