// Blocks that do the same at the same time: equal balls side by side, contacts and Zeno points of
// all in one instant. Each is what it is alone.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double g = 9.81;

struct Bodies {
  std::vector<std::shared_ptr<Ball>> balls;
  std::shared_ptr<const Diagram> diagram;

  Bodies(const std::vector<double>& restitutions) {
    DiagramBuilder builder;
    for (const double e : restitutions) {
      balls.push_back(
          std::make_shared<Ball>(BallOptions{.g = g, .e = e}, text("ball_", balls.size())));
      builder.add(balls.back());
    }
    diagram = std::make_shared<Diagram>(builder.build());
  }
  /// All from the same height, at rest.
  Context context(double y) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2 * static_cast<Index>(balls.size()));
    for (Index i = 0; i < x.size(); i += 2) x[i] = y;
    return diagram->create_context().with_continuous_state(x);
  }
};

}  // namespace

TEST_CASE("equal balls in one diagram do the same to the last bit, in the same passes",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const double e = GENERATE(0.0, 0.5, 1.0);
  const int n = 5;
  const Bodies bodies(std::vector<double>(n, e));
  const auto results = simulate(*bodies.diagram, bodies.context(1.0), {0.0, 3.0},
                                {.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method});
  const auto& x = results.context.continuous_state();
  const auto first = results.events.times("ball_0.bounce");
  CHECK(first.size() >= 1);
  for (int i = 1; i < n; ++i) {
    INFO("method " << method << ", e " << e << ", ball " << i);
    CHECK(results.events.times(text("ball_", i, ".bounce")) == first);
    CHECK(x[2 * i] == x[0]);
    CHECK(x[2 * i + 1] == x[1]);
  }
  // One pass for all: j counts contacts, not balls.
  if (e == 1.0)
    CHECK(results.events[results.events.size() - 1].jump == static_cast<int>(first.size()));
}

TEST_CASE("balls of unlike restitution meet the floor together once, then each alone",
          "[laws][ball][zeno]") {
  const auto method = GENERATE(from_range(methods));
  const std::vector<double> restitutions{0.0, 0.2, 0.5, 0.8, 1.0};
  const Bodies bodies(restitutions);
  const double rtol = 1e-9, atol = 1e-11, end = 4.0;
  const auto results = simulate(*bodies.diagram, bodies.context(1.0), {0.0, end},
                                {.rtol = rtol, .atol = atol, .ode_solver_method = method});
  CHECK(results.status == Status::reached_end);
  for (std::size_t i = 0; i < restitutions.size(); ++i) {
    const BallExact exact{g, restitutions[i], 1.0};
    std::vector<double> expected;
    for (int k = 1; k <= 3 && (restitutions[i] > 0.0 || k == 1) && exact.contact(k) < end; ++k)
      expected.push_back(exact.contact(k));
    auto found = results.events.times(text("ball_", i, ".bounce"));
    if (found.size() > expected.size()) found.resize(expected.size());
    // A flight of one is cut by the contacts of the others: 200 steps at most, each a location's
    // rounding, or the errors of a multistep method that starts anew; of three flights, carried on.
    // A contact of speed 4.4 e^k turns heights into times.
    const double slowest = 4.43 * std::pow(std::max(restitutions[i], 0.2), 2.0);
    const double made =
        one_step(method) ? 400.0 * eps * end : (rtol + atol) / slowest + (rtol * 4.43 + atol) / g;
    within(text("unlike balls e=", restitutions[i]), method, worst(found, expected),
           200.0 * 9.0 * made);
  }
}
