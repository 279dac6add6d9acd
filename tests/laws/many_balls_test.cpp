// N balls in one leaf: one guard of N numbers, one reset map that asks which of them it was. They
// are N balls alone: each bounces, accumulates and rests for itself.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

/// State: N heights, then N velocities.
std::shared_ptr<Leaf> balls(const Eigen::VectorXd& heights, double e) {
  return make_leaf("balls", [=](Leaf& l) {
    const Index n = heights.size();
    Eigen::VectorXd start = Eigen::VectorXd::Zero(2 * n);
    start.head(n) = heights;
    l.declare_continuous_state({.initial = start, .ode = [=](const At& at, VectorRef xdot) {
                                  xdot << at.x.tail(n), Eigen::VectorXd::Constant(n, -g);
                                }});
    std::vector<std::vector<int>> holds;
    for (int i = 0; i < n; ++i) holds.push_back({i, static_cast<int>(n) + i});
    l.declare_zero_crossing({.name = "bounce",
                             .guard =
                                 [](const At& at, VectorRef h) {
                                   for (Index i = 0; i < h.size(); ++i) h[i] = at.x[i];
                                 },
                             .reset_map =
                                 [=](const At& at, Next& next) {
                                   Eigen::VectorXd x = at.x;
                                   x[at.entry] = 0.0;
                                   x[n + at.entry] *= -e;
                                   next.set_continuous_state(x);
                                 },
                             .direction = Direction::positive_then_non_positive,
                             .size = n,
                             .holds = holds});
  });
}

}  // namespace

TEST_CASE("N balls in one leaf bounce each for itself", "[laws][ball]") {
  const auto method = GENERATE(from_range(methods));
  const Eigen::VectorXd heights = vec({1.0, 2.0, 2.0, 0.5, 5.0});
  const double rtol = 1e-9, atol = 1e-11, end = 3.0, e = 0.9;
  std::vector<double> expected;  // of all of them; those of equal height together, each its own
  for (const double h : heights) {
    const BallExact exact{g, e, h};
    for (int k = 1; exact.contact(k) < end; ++k) expected.push_back(exact.contact(k));
  }
  std::ranges::sort(expected);
  for (const Form& form : forms(balls(heights, e))) {
    const auto results = simulate(*form.system, form.context(), {0.0, end},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    // As one ball, with a solver step for each contact of another: 40 steps a flight, ten flights,
    // each error of speed carried on.
    const double made = one_step(method) ? 400.0 * eps * end : 40.0 * (rtol * 10.0 + atol) / g;
    within(text("five balls ", form.name), method, worst(firing_times(results.events), expected),
           10.0 * 10.0 * made);
  }
}

TEST_CASE("of N balls in one leaf some rest while others bounce", "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const Eigen::VectorXd heights = vec({0.0, 1e-3, 1.0, 20.0});
  const double rtol = 1e-9, atol = 1e-12, e = 0.5, end = 5.0;
  // At rest from the start; from 0.043 s; from 1.35 s; in flight until 6 s.
  for (const Form& form : forms(balls(heights, e))) {
    const auto results = simulate(*form.system, form.context(), {0.0, end},
                                  {.rtol = rtol, .atol = atol, .ode_solver_method = method});
    CHECK(results.status == Status::reached_end);
    CHECK(count(results.events, EventKind::zeno_enter) == 3);
    const auto& x = results.context.continuous_state();
    const BallExact exact{g, e, 20.0};
    const double since = end - exact.contact(2);  // 4.04 s; the third contact is at 5.05 s
    const double speed = exact.speed(2);
    const double made = one_step(method) ? 400.0 * eps * 20.0 : 120.0 * (rtol * 20.0 + atol);
    within(text("four balls, rest ", form.name), method,
           std::max(x.head(3).cwiseAbs().maxCoeff(), x.segment(4, 3).cwiseAbs().maxCoeff()), 1e-8);
    within(text("four balls, flight ", form.name), method,
           std::abs(x[3] - (speed * since - 0.5 * g * since * since)), 10.0 * made * end);
  }
}
