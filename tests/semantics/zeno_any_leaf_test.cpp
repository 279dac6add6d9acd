// Semantics 4.1, 4.3: the monitor is the engine's, in any leaf; its tolerance, its prediction.
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

/// Two tanks that leak 2 l/s each, one hose of 3 l/s: it goes to the one that has run empty. The
/// sum falls by 1 l/s, so all switching accumulates when the sum has run out.
Leaf tanks() {
  return Leaf("tanks", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 1.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << (at.mode == 0 ? 1.0 : -2.0), (at.mode == 1 ? 1.0 : -2.0);
         }});
    l.declare_default_mode(0);
    for (const Index i : {0, 1}) {
      l.declare_zero_crossing({.name = text("empty_", i),
                               .guard = [=](const At& at) { return at.x[i]; },
                               .reset_map =
                                   [=](const At& at, Next& next) {
                                     Eigen::VectorXd x = at.x;
                                     x[i] = 0.0;
                                     next.set_continuous_state(x);
                                   },
                               .direction = Direction::positive_then_non_positive,
                               .start_mode = static_cast<int>(1 - i),
                               .end_mode = static_cast<int>(i)});
    }
  });
}

/// The gap before the first zeno_enter of the ball's own guard.
double entered_at(const Results& results) {
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_enter) return results.events[i].time;
  }
  return infinite;
}

}  // namespace

TEST_CASE("4.1 a leaf that is no ball comes to rest too: two tanks and one hose", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = tanks();
  const double rtol = 1e-10, atol = 1e-13;
  const auto results =
      simulate(leaf, leaf.create_context(), {0.0, 5.0},
               {.rtol = rtol, .atol = atol, .ode_solver_method = method, .throw_errors = false});
  CHECK(results.status == Status::reached_end);
  REQUIRE(count(results.events, EventKind::zeno_enter) == 1);
  for (std::size_t i = 0; i < results.events.size(); ++i) {
    if (results.events[i].kind == EventKind::zeno_enter)
      CHECK_THAT(results.events[i].predicted, WithinAbs(2.0, 1e-9));
  }
  CHECK(results.context.continuous_state().lpNorm<Eigen::Infinity>() < 1e-9);
}

TEST_CASE(
    "4.1 the tolerance is 1e-6 s, of the options, and each guard or Integrator may override it",
    "[semantics]") {
  CHECK(SimulatorOptions{}.zeno_tolerance == 1e-6);
  // g = 10, h = 0.2, e = 1/2: gaps 0.2, 0.1, 0.05, ... s after the first contact at 0.2 s. The hold
  // begins with the first gap that is not longer than the tolerance, 0.2 / 2^k.
  const BallOptions ball{.g = 10.0, .e = 0.5};
  BallOptions patient = ball;
  patient.zeno_tolerance = 0.003;
  const BallExact exact{10.0, 0.5, 0.2};
  const SimulatorOptions options{.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = Method::dopri5};
  SimulatorOptions loose = options;
  loose.zeno_tolerance = 0.003;
  for (std::size_t i = 0; i < all_forms(ball).size(); ++i) {
    const BallScene by_guard = all_forms(patient)[i], by_options = all_forms(ball)[i];
    INFO(by_guard.form);
    const auto a = simulate(*by_guard.system, by_guard.context(0.2, 0.0), {0.0, 1.0}, options);
    const auto b = simulate(*by_options.system, by_options.context(0.2, 0.0), {0.0, 1.0}, loose);
    const auto c = simulate(*by_guard.system, by_guard.context(0.2, 0.0), {0.0, 1.0}, loose);
    CHECK_THAT(entered_at(a), WithinAbs(exact.contact(9), 1e-7));  // 0.2 / 2^7 = 0.0016 s
    CHECK(entered_at(b) == entered_at(a));
    CHECK(entered_at(c) == entered_at(a));
  }
}

TEST_CASE("4.3 a monitored guard that never rests logs no prediction", "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  const BallScene scene = leaf({.e = 1.0});
  const auto results =
      simulate(*scene.system, scene.context(1.0, 0.0), {0.0, 5.0}, {.ode_solver_method = method});
  for (std::size_t i = 0; i < results.events.size(); ++i)
    CHECK(std::isnan(results.events[i].predicted));
}
