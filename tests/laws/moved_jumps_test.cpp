// The flow jumps without an event, at a time or a state that a parameter moves: the derivatives have the
// jump term where the flow is a formula, and a gap where it is called.
#include <cmath>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace moved_jumps {
namespace {

constexpr Method methods[] = {Method::automatic, Method::dopri5, Method::dop853,
                              Method::radau,     Method::bdf,    Method::adams};

/// x' = 1 + 2 [t > p] - x / 2 - 3 [x > q], from x = 0.
Leaf jumping(double p, double q, bool called) {
  return Leaf("jumping", [=](Leaf& l) {
    const ParameterIndex on = l.declare_dynamic_parameter("p", p),
                         level = l.declare_dynamic_parameter("q", q);
    ContinuousState state{.initial = vec({0.0})};
    if (called)
      state.ode = [=](const At& at, VectorRef xdot) {
        xdot[0] = 1.0 + (at.time > at.p[on] ? 2.0 : 0.0) - 0.5 * at.x[0] -
                  (at.x[0] > at.p[level] ? 0.7 : 0.0);
      };
    else
      state.formula = Formula([=](const auto& at) {
        return 1.0 + at.choose(at.time() > at.p(on, 0), 2.0, 0.0) - 0.5 * at.x(0) -
               at.choose(at.x(0) > at.p(level, 0), 0.7, 0.0);
      });
    l.declare_continuous_state(std::move(state));
  });
}

Results run(const Leaf& leaf, Method method) {
  SimulatorOptions options{.rtol = 1e-9, .atol = 1e-11, .ode_solver_method = method};
  options.sensitivity = {"p", "q", "x[0]"};
  return simulate(leaf, leaf.create_context(), {0.0, 3.0}, options);
}

/// The derivatives at 3 s by p, q and x0, in closed form. Up to p: x = 2 - 2 e^(-t/2) + x0 e^(-t/2). Then
/// x = 6 + (x(p) - 6) e^(-(t - p)/2) up to q at s, and x = 4.6 + (q - 4.6) e^(-(t - s)/2) after it.
Eigen::Vector3d closed_form(double p, double q) {
  const double before = std::exp(-0.5 * p), at_p = 2.0 - 2.0 * before;
  const double s = p - 2.0 * std::log((q - 6.0) / (at_p - 6.0));
  const double after = std::exp(-0.5 * (3.0 - s));
  const double by_s = 0.5 * (q - 4.6) * after;  // of x(3)
  // e^(-(s - p)/2) (x(p) - 6) = q - 6, so s = p - 2 log((q - 6) / (x(p) - 6))
  const double s_by_at_p = 2.0 / (at_p - 6.0);
  return {by_s * (1.0 + s_by_at_p * before), after + by_s * (-2.0 / (q - 6.0)),
          by_s * s_by_at_p * before};
}

}  // namespace

TEST_CASE("a formula that jumps at a time and a state has derivatives") {
  for (const Method method : methods) {
    CAPTURE(static_cast<int>(method));
    const Results results = run(jumping(0.7, 2.3, false), method);
    CHECK(results.sensitivities.gaps.empty());
    const Eigen::Vector3d expected = closed_form(0.7, 2.3);
    // A crossing is off by the error of the state there: some hundred tolerances with multistep methods.
    for (Index k = 0; k < 3; ++k)
      CHECK_THAT(nth(results.sensitivities.continuous_state, k), WithinAbs(expected[k], 1e-6));
  }
}

TEST_CASE("where it is called there is a gap") {
  for (const Method method : methods) {
    CAPTURE(static_cast<int>(method));
    const Results results = run(jumping(0.7, 2.3, true), method);
    CHECK(results.sensitivities.gaps.size() == 3);
    for (const double one : results.sensitivities.continuous_state) CHECK(std::isnan(one));
  }
}

TEST_CASE("a called jump that does not move has none") {
  const Leaf leaf("fixed", [](Leaf& l) {
    const ParameterIndex rate = l.declare_dynamic_parameter("rate", 2.0);
    l.declare_continuous_state({.initial = vec({0.0}), .ode = [=](const At& at, VectorRef xdot) {
                                  xdot[0] = at.time > 1.0 ? at.p[rate] : 0.0;
                                }});
  });
  SimulatorOptions options{};
  options.sensitivity = {"rate"};
  const Results results = simulate(leaf, leaf.create_context(), {0.0, 3.0}, options);
  CHECK(results.sensitivities.gaps.empty());
  CHECK_THAT(results.sensitivities.continuous_state.at(0), WithinAbs(2.0, 1e-6));
}

}  // namespace moved_jumps
