// The Radau methods: their coefficients and their decisions.
#include "saltus/solver/detail/radau/allowed_estimate.hpp"
#include "saltus/solver/detail/radau/convergence.hpp"
#include "saltus/solver/detail/radau/damping.hpp"
#include "saltus/solver/detail/radau/stage_polynomial.hpp"
#include "saltus/solver/detail/radau/step_choice.hpp"
#include "saltus/solver/detail/radau/step_control.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// x'' = -x from (1, 0): x = cos t.
Leaf oscillator() {
  return Leaf("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
  });
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
  // A correction below the tolerance that does not shrink is not converged: only rounding excuses
  // it.
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
  CHECK(next_stages({.stages = 7, .theta = 0.1}) == 7);
  CHECK(next_stages({.stages = 5, .newton_failed = true}) == 3);
  CHECK(next_stages({.stages = 3, .newton_failed = true}) == 3);
  // Below the usual number it rises sooner.
  CHECK(next_stages({.stages = 3, .theta = 0.01, .ratio = 1.0, .steps = 10, .usual = 7}) == 5);
  CHECK(next_stages({.stages = 5, .theta = 0.01, .ratio = 1.0, .steps = 10, .usual = 5}) == 5);
  CHECK(next_stages({.stages = 5, .theta = 0.03, .ratio = 1.0, .steps = 10, .usual = 7}) == 5);
}

TEST_CASE("one fast iteration of Newton does not raise the order, and a slow one is forgotten",
          "[radau]") {
  radau::StepChoice choice(1e-3);
  const auto step = [&](double theta) {
    radau::Convergence newton(1e-9, 0.0, 10, std::numeric_limits<double>::infinity());
    newton.look(1.0), newton.look(theta);
    REQUIRE(newton.theta() == theta);
    choice.accept(
        {.h = 1.0, .error = 0.5, .ratio = 1.0, .rejected_before = false, .jacobian_kept = true},
        newton);
  };
  for (int pair = 0; pair < 20; ++pair) step(0.01), step(1e-6);  // the first alone keeps the order
  CHECK(choice.stages() == 3);
  step(0.01);
  for (int fast = 0; fast < 10; ++fast) step(1e-6);
  CHECK(choice.stages() == 5);
}

TEST_CASE("the first steps have more stages at a tighter tolerance", "[radau]") {
  CHECK(radau::first_stages(2e-6) == 3);
  CHECK(radau::first_stages(1e-6) == 5);
  CHECK(radau::first_stages(2e-9) == 5);
  CHECK(radau::first_stages(1e-9) == 7);
}

TEST_CASE("the length of a step follows its error, and the trend of the errors", "[radau]") {
  const double order = 4.0, safety = 0.9;
  const auto first = [&](double error) {
    return radau::PredictiveControl().accept(error, 1.0, order, safety, false);
  };
  CHECK_THAT(first(1.0), WithinRel(0.9, 1e-12));
  CHECK_THAT(first(1e-2), WithinRel(0.9 * std::sqrt(10.0), 1e-12));
  CHECK(first(0.0) == 8.0);
  // A step shorter than the one before expects its error to shrink by as much again: 0.9 (0.1 /
  // 0.5^2) of the error, with half of the length.
  radau::PredictiveControl control;
  control.accept(0.1, 2.0, order, safety, false);
  CHECK_THAT(control.accept(0.5, 1.0, order, safety, false),
             WithinRel(0.9 * 0.5 * std::pow(0.4, 0.25), 1e-12));
  // An error below a hundredth counts as that.
  control = {};
  control.accept(1e-6, 1.0, order, safety, false);
  CHECK_THAT(control.accept(1e-2, 1.0, order, safety, false),
             WithinRel(0.9 * std::sqrt(10.0), 1e-12));
  CHECK(control.accept(1e-2, 1.0, order, safety, true) == 1.0);  // after a rejection
  CHECK(radau::PredictiveControl::reject(1.0, 2.0, order, 1.0) == 1.8);
  CHECK(radau::PredictiveControl::reject(1e30, 2.0, order, 0.9) == 0.2);
  // One of seven iterations, and all of them; a step is kept for gains of less than a fifth.
  CHECK_THAT(radau::safety_of(1, 7), WithinRel(0.9, 1e-12));
  CHECK_THAT(radau::safety_of(7, 7), WithinRel(0.9 * 15.0 / 21.0, 1e-12));
  CHECK(radau::not_worth_it(1.1));
  CHECK_FALSE(radau::not_worth_it(1.3));
  CHECK_FALSE(radau::not_worth_it(0.9));
}

TEST_CASE("a slow iteration asks for a step in which it would be fast enough", "[radau]") {
  // theta = 0.9 leaves 9 * 9 * 0.9^4 / 0.1 = 531 tolerances after seven iterations, 20 count.
  radau::Convergence slow(0.1, 1e-8, 7, infinite);
  slow.look(10.0), slow.look(9.0);
  CHECK_THAT(slow.shorter(), WithinRel(0.8 * std::pow(20.0, -1.0 / 8.0), 1e-12));
  radau::Convergence less(0.1, 1e-8, 7, infinite);
  less.look(10.0), less.look(5.0);  // 1 * 5 * 0.5^4 / 0.1
  CHECK_THAT(less.shorter(), WithinRel(0.8 * std::pow(3.125, -1.0 / 8.0), 1e-12));
}

TEST_CASE("a slow part may have the estimate of a step as long as its own error allows",
          "[radau]") {
  // 0.1 rtol^(4/6 - 1) = 0.1 * 100 at 1e-6; at 1e-14 the dense output bounds it: 4 * 2^4 / share.
  const radau::Scheme three = radau::scheme_of(3);
  CHECK_THAT(radau::slow_estimate(three, 1e-6, 4.0), WithinRel(10.0, 1e-12));
  CHECK_THAT(radau::slow_estimate(three, 1e-14, 4.0), WithinRel(64.0 / three.dense_share, 1e-12));
}

TEST_CASE("a fast part may have the estimate of which S times is the error", "[radau]") {
  const int stages = GENERATE(3, 5, 7);
  const radau::Scheme scheme = radau::scheme_of(stages);
  // The barycentric weights are 1 / w' at the nodes 0 and 1 of the node polynomial w.
  CHECK_THAT(std::abs(scheme.weights[0] / scheme.weights[stages]), WithinRel(stages, 1e-12));
  CHECK(radau::fast_estimate(scheme, 10.0) == 2.0 / stages);
  CHECK(radau::fast_estimate(scheme, 0.1) == 0.1);
  const radau::AllowedEstimate allowed(scheme, 1e-6, 4.0);
  const double slow = radau::slow_estimate(scheme, 1e-6, 4.0);
  CHECK(allowed.of(1.0) == slow);
  CHECK_THAT(allowed.of(0.5), WithinRel(std::sqrt(slow * 2.0 / stages), 1e-12));
  CHECK_THAT(allowed.of(0.0), WithinRel(2.0 / stages, 1e-12));
}

TEST_CASE("two tries of a step tell what it has inherited from what is its own", "[radau]") {
  using radau::inherited_estimate;
  // Estimates 3 + 8 and 3 + 1 of steps of h and h / 2 with three stages, with both signs.
  CHECK(inherited_estimate(11.0, 4.0, 0.125, 10.0) == 3.0);
  CHECK(inherited_estimate(-5.0, 2.0, 0.125, 10.0) == 3.0);
  // An error that is the step's own shrinks, and nothing is excused; a transient is resolved.
  CHECK(inherited_estimate(8.0, 1.0, 0.125, 10.0) == 0.0);
  CHECK(inherited_estimate(1e6, 1e6, 0.125, 4.0) == 4.0);
  CHECK(inherited_estimate(-1e6, -1e6, 0.125, 4.0) == -4.0);
}

TEST_CASE("an estimate is smaller than the error allowed only where it shows its order",
          "[radau]") {
  using radau::shown_order;
  // Of order 8, at half the step: as h^8, as h^6, as h^4, behind a kink as h^2, behind a jump as h.
  CHECK(shown_order(256.0, 1.0, 0.5, 8.0) == 1.0);
  CHECK_THAT(shown_order(-64.0, 1.0, 0.5, 8.0), WithinRel(0.5, 1e-12));
  CHECK(shown_order(16.0, 1.0, 0.5, 8.0) == 0.0);
  CHECK(shown_order(4.0, -1.0, 0.5, 8.0) == 0.0);
  CHECK(shown_order(2.0, 1.0, 0.5, 8.0) == 0.0);
  CHECK(shown_order(0.0, 1.0, 0.5, 8.0) == 0.0);  // it grows
  CHECK(shown_order(0.0, 0.0, 0.5, 8.0) == 1.0);  // there is no error
}

TEST_CASE("looks inside steps change no bit of them", "[radau]") {
  const Leaf leaf = oscillator();
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
  const Leaf leaf = oscillator();
  const auto refused = message<ModelError>([&] {
    simulate(leaf, leaf.create_context(), {0.0, 1.0},
             {.ode_solver_method = Method::radau, .linear_solver = LinearSolver::gmres});
  });
  CHECK(contains(refused, "'gmres'"));
  CHECK(contains(refused, "'bdf'"));
}

TEST_CASE("Radau damps an oscillation by five steps of its own length", "[radau]") {
  radau::Damping damping;
  CHECK(!damping.goes_on());
  damping.begin(100.0, 8.0, 1.0);
  REQUIRE(damping.goes_on());
  CHECK_THAT(damping.length(), WithinRel(0.1, 1e-12));
  CHECK(damping.by(0.1));
  CHECK(!damping.by(0.05));  // to a stop time
  CHECK(damping.allows(16.0));
  CHECK(!damping.allows(17.0));
  CHECK(!damping.allows(std::numeric_limits<double>::quiet_NaN()));
  // Each estimate may be half of the one before.
  damping.accept(10.0);
  CHECK(damping.allows(5.0));
  CHECK(!damping.allows(6.0));
  for (int i = 0; i < 4; ++i) damping.accept(1.0);
  CHECK(!damping.goes_on());
  CHECK(!damping.by(0.1));
  damping.begin(100.0, 8.0, 0.01);  // a largest step that is too short
  CHECK(!damping.goes_on());
  damping.begin(0.0, 8.0, 1.0);  // no oscillation
  CHECK(!damping.goes_on());
}

TEST_CASE("Radau is within ten tolerances where the absolute tolerance is the larger part",
          "[radau]") {
  // At rtol 1e-12 alone a slow estimate may be 14 000 tolerances; that is an error of 14 with atol
  // = 1e-3.
  const double rtol = GENERATE(1e-6, 1e-9, 1e-12), atol = GENERATE(1e-2, 1e-3, 1e-5);
  const Leaf leaf = oscillator();
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 20.0},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = Method::radau});
  INFO("rtol " << rtol << ", atol " << atol << ": " << results.statistics.steps << " steps");
  const Eigen::Vector2d exact(std::cos(20.0), -std::sin(20.0));
  CHECK((results.context.continuous_state() - exact).cwiseAbs().maxCoeff() < 10.0 * (atol + rtol));
}
