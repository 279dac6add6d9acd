// Dense sensitivities: the derivatives of a run between its rows.
#include <cmath>
#include <limits>

#include "support/balls.hpp"
#include "support/islands.hpp"
#include "support/oscillator.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace {

const std::vector<std::string> by = {"g", "floor", "x[0]"};

/// A ball that falls 5 m in 1 s, and has a kinetic energy beside its state.
std::shared_ptr<Leaf> ball() {
  return make_leaf("ball", [](Leaf& l) {
    l.declare_dynamic_parameter("g", 10.0), l.declare_dynamic_parameter("floor", 0.0);
    l.declare_continuous_state({.initial = vec({5.0, 0.0}), .ode = [](const At& at, VectorRef out) {
                                  out << at.x[1], -at.p[0];
                                }});
    l.declare_continuous_state_output("x");
    l.declare_output_port(
        {.name = "energy", .calc = [](const At& at) { return 0.5 * at.x[1] * at.x[1]; }});
    l.declare_zero_crossing(
        {.name = "bounce",
         .guard = [](const At& at) { return at.x[0] - at.p[1]; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state({at.p[1], -0.5 * at.x[1]}); },
         .direction = Direction::positive_then_non_positive});
  });
}

SimulatorOptions options_of(const Leaf& leaf, Method method) {
  return {.rtol = 1e-10,
          .atol = 1e-12,
          .ode_solver_method = method,
          .sensitivity = by,
          .recorded_signals = {{"x", leaf.output(0)}, {"energy", leaf.output(1)}},
          .dense_output = true};
}

/// d(y, v)/d(g, floor, y0) of the closed form, with t1 = sqrt(2 (y0 - floor) / g) = 1.
Eigen::MatrixXd exact(double t) {
  Eigen::MatrixXd d(2, 3);
  if (t < 1.0) return (d << -0.5 * t * t, 0.0, 1.0, -t, 0.0, 0.0).finished();
  const double s = t - 1.0;
  const Eigen::RowVector3d t1(-0.05, -0.1, 0.1);
  d.row(0) = (15.0 * s - 5.0) * t1, d.row(1) = 15.0 * t1.array();
  d(0, 0) += 0.5 * s - 0.5 * s * s, d(1, 0) += 0.5 - s;
  d(0, 1) += 1.0;
  return d;
}

double worst(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the derivatives of a ball between its rows and at an impact", "[dense][sensitivity]") {
  const auto method = GENERATE(Method::automatic, Method::dopri5, Method::dop853, Method::adams,
                               Method::bdf, Method::radau);
  INFO("method " << method);
  const auto leaf = ball();
  const Results run =
      simulate(*leaf, leaf->create_context(), {0.0, 1.8}, options_of(*leaf, method));
  // The time of the impact is known to some tolerances of the state, 1e-9 relative, with multistep
  // methods; the derivatives are smooth functions of it.
  const double tolerance = 1e-7;
  for (const double t : {0.0, 0.1, 0.37, 0.999, 1.001, 1.3, 1.77, 1.8}) {
    INFO("t = " << t);
    const MomentSensitivities found = run.sensitivities_at(t);
    CHECK(worst(found.continuous_state, exact(t)) < tolerance);
    CHECK(found.output("x") == found.continuous_state);
    const double v = run.at(t).continuous_state[1];
    CHECK(worst(found.output("energy"), v * exact(t).row(1)) < 20.0 * tolerance);
  }
  const double impact = run.events[0].time;
  CHECK(worst(run.sensitivities_at(impact, Side::left).continuous_state, exact(1.0 - 1e-12)) <
        tolerance);
  CHECK(worst(run.sensitivities_at(impact).continuous_state, exact(1.0)) < tolerance);
  CHECK(run.sensitivities_at(1.0).parameters == by);
  CHECK_THROWS_AS(run.sensitivities_at(1.9), ModelError);
  CHECK_THROWS_AS(run.sensitivities_at(1.0).output("y"), ModelError);
}

// Those of states to the bit. Those of the energy are differences with shifts of 1e-3, of values up
// to 50 at a state that rounding may move: 50 eps / 1e-3 = 1e-11.
TEST_CASE("at a recorded row they are those of the row", "[dense][sensitivity]") {
  const auto method = GENERATE(Method::automatic, Method::dop853, Method::bdf, Method::radau);
  INFO("method " << method);
  const auto leaf = ball();
  SimulatorOptions options = options_of(*leaf, method);
  options.save_at = {0.0, 0.25, 0.5, 1.25, 1.5, 2.2}, options.save_steps = true;
  const Results run = simulate(*leaf, leaf->create_context(), {0.0, 2.4}, options);
  const Sensitivities& rows = run.sensitivities;
  REQUIRE(run.jump.back() == 2);
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const bool before = i + 1 < run.time.size() && run.time[i + 1] == run.time[i];
    const auto found = run.sensitivities_at(run.time[i], before ? Side::left : Side::right);
    INFO("t = " << run.time[i] << ", before an event " << before);
    for (Index k = 0; k < 3; ++k) {
      for (Index j = 0; j < 2; ++j)
        CHECK(found.output("x")(j, k) == nth(rows.signals[0], 6 * Index(i) + 3 * j + k));
      CHECK_THAT(found.output("energy")(0, k),
                 WithinAbs(nth(rows.signals[1], 3 * Index(i) + k), 1e-10));
    }
  }
}

TEST_CASE("sampled signals have derivatives between rows, also without states",
          "[dense][sensitivity]") {
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.5);
  builder.connect(sine.output(), hold.input());
  const Diagram diagram = builder.build();
  const Results run =
      simulate(diagram, diagram.create_context(), {0.0, 2.0},
               {.sensitivity = {"sine.amplitude"},
                .recorded_signals = {{"sine", sine.output()}, {"hold", hold.output()}},
                .dense_output = true});
  // The differences of a function that is linear in the parameter have their rounding only.
  CHECK_THAT(run.sensitivities_at(0.7).output("sine")(0, 0), WithinAbs(std::sin(0.7), 1e-11));
  CHECK_THAT(run.sensitivities_at(0.7).output("hold")(0, 0), WithinAbs(std::sin(0.5), 1e-11));
  CHECK(run.sensitivities_at(0.5, Side::left).output("hold")(0, 0) == 0.0);
}

TEST_CASE("a run in pieces has one trajectory of derivatives, one taken out begins another",
          "[dense][sensitivity]") {
  const auto leaf = ball();
  Simulator simulator(*leaf, options_of(*leaf, Method::dopri5));
  simulator.initialize(leaf->create_context());
  for (const double t : {0.25, 0.75, 0.75, 1.5}) simulator.advance_to(t);
  const Results taken = simulator.take_results();
  simulator.advance_to(1.8);
  const Results& rest = simulator.results();
  CHECK(rest.sensitivities.parameters == by);
  for (const double t : {0.1, 0.75, 1.2, 1.5})
    CHECK(worst(taken.sensitivities_at(t).continuous_state, exact(t)) < 1e-9);
  for (const double t : {1.5, 1.7, 1.8})
    CHECK(worst(rest.sensitivities_at(t).continuous_state, exact(t)) < 1e-9);
  CHECK_THROWS_AS(rest.sensitivities_at(1.2), ModelError);
}

TEST_CASE("a failed run has derivatives up to where it failed", "[dense][sensitivity][errors]") {
  const auto leaf = make_leaf("fails", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing({.name = "wall",
                             .guard = [](const At& at) { return at.x[0] - 1.0; },
                             .reset_map = [](const At&, Next&) { throw Error("no"); }});
  });
  const Results run =
      simulate(*leaf, leaf->create_context(), {0.0, 2.0},
               {.sensitivity = {"x[0]"}, .dense_output = true, .throw_errors = false});
  REQUIRE(run.status == Status::failed);
  CHECK_THAT(run.sensitivities_at(0.4).continuous_state(0, 0), WithinAbs(1.0, 1e-12));
  CHECK_THAT(run.sensitivities_at(run.trajectory.end()).continuous_state(0, 0),
             WithinAbs(1.0, 1e-12));
}

TEST_CASE("derivatives between rows need both options", "[dense][sensitivity][errors]") {
  const auto leaf = ball();
  SimulatorOptions options = options_of(*leaf, Method::dopri5);
  options.dense_output = false;
  const Results rows = simulate(*leaf, leaf->create_context(), {0.0, 0.5}, options);
  CHECK_THROWS_WITH(rows.sensitivities_at(0.1), Catch::Contains("dense_output"));
  CHECK(rows.sensitivities.trajectory.empty());
  options.dense_output = true, options.sensitivity.clear();
  const Results states = simulate(*leaf, leaf->create_context(), {0.0, 0.5}, options);
  CHECK_THROWS_WITH(states.sensitivities_at(0.1), Catch::Contains("sensitivity"));
}

TEST_CASE("after a gap there is no derivative between rows", "[dense][sensitivity]") {
  const auto leaf = make_leaf("touch", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({1.0, -2.0}),
                                .ode = [](const At& at, VectorRef out) { out << at.x[1], 2.0; }});
    l.declare_zero_crossing(
        {.name = "touch",
         .guard = [](const At& at) { return at.x[0] - 1e-10; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({5.0, 0.0}); },
         .direction = Direction::positive_then_non_positive});
  });
  const Results run = simulate(*leaf, leaf->create_context(), {0.0, 2.0},
                               {.sensitivity = {"x[0]"}, .dense_output = true});
  REQUIRE(run.sensitivities.gaps.size() == 1);
  CHECK_THAT(run.sensitivities_at(0.5).continuous_state(0, 0), WithinAbs(1.0, 1e-12));
  CHECK(std::isnan(run.sensitivities_at(1.5).continuous_state(0, 0)));
}

TEST_CASE("an island has the derivatives of its part alone between rows", "[dense][islands]") {
  const auto run = [](const std::set<int>& parts, std::vector<std::string> names) {
    const Diagram scene = scene_of(parts);
    return simulate(scene, start_of(scene, parts), {0.0, 1.0},
                    {.sensitivity = std::move(names),
                     .recorded_signals = outputs_of(scene),
                     .dense_output = true,
                     .islands = true})
        .sensitivities_at(0.7);
  };
  const MomentSensitivities both = run({0, 1}, {"second.g", "first.g"}),
                            first = run({0}, {"first.g"}), second = run({1}, {"second.g"});
  const Index n = first.continuous_state.rows(), m = second.continuous_state.rows();
  CHECK(both.continuous_state.col(1).head(n) == first.continuous_state.col(0));
  CHECK(both.continuous_state.col(0).tail(m) == second.continuous_state.col(0));
  CHECK(both.continuous_state.col(0).head(n).isZero(0.0));
  CHECK(both.outputs[0].second.col(1) == first.outputs[0].second.col(0));
  CHECK(both.outputs[1].second.col(0) == second.outputs[0].second.col(0));
  CHECK(both.outputs[1].second.col(1).isZero(0.0));
}
