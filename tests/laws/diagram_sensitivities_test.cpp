// Derivatives by the parameters of a diagram: the chain rule over those of its blocks.
#include <saltus/models/bouncing_ball.hpp>

#include <cmath>

#include "saltus/simulation/linearize.hpp"
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double k0 = 4.905, q0 = 0.8, height = 10.0;

/// A ball whose gravity is 2 k, and whose restitution is 1.4 - q^2.
Diagram thrown() {
  DiagramBuilder builder;
  const ParameterIndex k = builder.declare_parameter("k", k0);
  const ParameterIndex q = builder.declare_parameter("q", q0);
  auto& ball = builder.add<models::BouncingBall>();
  builder.export_output(ball.output(), "y");
  builder.compute_parameter(ball, "g", [=](const auto& p) { return 2.0 * p(k); });
  builder.compute_parameter(ball, "e", [=](const auto& p) { return 1.4 - p(q) * p(q); });
  return builder.build("thrown");
}

Results run(const Diagram& diagram, std::vector<std::string> by, Method method = Method::dopri5,
            double t_end = 6.0) {
  Context context = diagram.create_context();
  context = context.with_continuous_state({height, 0.0});
  SimulatorOptions options{.rtol = 1e-10, .atol = 1e-12, .ode_solver_method = method};
  options.recorded_signals = {{"y", diagram.output(0)}}, options.sensitivity = std::move(by);
  return simulate(diagram, context, {0.0, t_end}, options);
}

/// |a - b| in units of the larger one.
double apart(double a, double b) {
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1.0});
}

}  // namespace

TEST_CASE("the impacts of a ball move with the parameters of its diagram, in closed form",
          "[sensitivity][diagram]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::radau, Method::taylor,
                               Method::adams, Method::bdf, Method::automatic);
  INFO("method " << to_string(method));
  const Sensitivities found = run(thrown(), {"k", "q"}, method).sensitivities;
  REQUIRE(found.gaps.empty());
  // t_n = sqrt(2 y0 / g) (1 + 2 sum of e^j, 0 < j < n), with dg/dk = 2 and de/dq = -2 q
  const double g = 2.0 * k0, e = 1.4 - q0 * q0, first = std::sqrt(2.0 * height / g);
  double powers = 1.0, slope = 0.0;
  REQUIRE(found.event_times.size() >= 6);
  for (std::size_t n = 0; 2 * n < found.event_times.size(); ++n) {
    // As in sensitivities_test: a hundred tolerances, amplified by each flight; the multistep
    // methods end each flight with their own error, some hundred tolerances more.
    const double allowed = method == Method::adams || method == Method::bdf ? 1e-6 : 1e-8;
    CHECK(std::abs(found.event_times[2 * n] + 2.0 * first * powers / (2.0 * g)) < allowed);
    CHECK(std::abs(found.event_times[2 * n + 1] + 2.0 * q0 * first * slope) < 40.0 * allowed);
    const double j = static_cast<double>(n) + 1.0;
    powers += 2.0 * std::pow(e, j), slope += 2.0 * j * std::pow(e, j - 1.0);
  }
}

TEST_CASE("they are the sums of the derivatives by the parameters of blocks",
          "[sensitivity][diagram]") {
  DiagramBuilder builder;
  const ParameterIndex k = builder.declare_parameter("k", k0);
  auto& ball = builder.add<models::BouncingBall>();
  builder.export_output(ball.output(), "y");
  builder.compute_parameter(ball, "g", [=](const auto& p) { return p(k) * p(k) / 2.0; });
  builder.compute_parameter(ball, "e", [=](const auto& p) { return 0.6 + p(k) / 50.0; });
  const Diagram diagram = builder.build("thrown");
  const auto check = [](const std::vector<double>& by) {
    REQUIRE(by.size() % 3 == 0);
    REQUIRE(!by.empty());
    // One linear equation for all columns: rounding, and the differences of the reset map (1e-10),
    // each times the growth over three impacts.
    for (std::size_t i = 0; i < by.size(); i += 3)
      CHECK(apart(by[i], k0 * by[i + 1] + by[i + 2] / 50.0) < 1e-8);
  };
  const Sensitivities found = run(diagram, {"k", "ball.g", "ball.e"}).sensitivities;
  check(found.event_times), check(found.continuous_state), check(found.signals.at(0));
}

TEST_CASE("an outer diagram computes the parameters of an inner one", "[sensitivity][diagram]") {
  DiagramBuilder inner, outer;
  const ParameterIndex a = inner.declare_parameter("a", 0.0);
  auto& one = inner.add<Constant>("one", 1.0);
  auto& gain = inner.add<Gain>("gain", 0.0);
  auto& x = inner.add<Integrator>("x", Integrator::Options{});
  inner.connect(one.output(), gain.input());
  inner.connect(gain.output(), x.input());
  inner.compute_parameter(gain, "gain", [=](const auto& p) { return p(a) * p(a); });
  const auto part = std::make_shared<Diagram>(inner.build("part"));
  const ParameterIndex m = outer.declare_parameter("m", 3.0);
  outer.add(part);
  outer.compute_parameter(*part, "a", [=](const auto& p) { return 1.0 / p(m); });
  const Diagram diagram = outer.build();
  for (const bool islands : {false, true}) {
    INFO("islands " << islands);
    SimulatorOptions options{.islands = islands};
    options.sensitivity = {"m", "part.a", "part.gain.gain"};
    const Results results = simulate(diagram, diagram.create_context(), {0.0, 2.0}, options);
    // x(2) = 2 / m^2 = 2 a^2 = 2 gain; the default tolerance, and the flow is constant
    const auto& by = results.sensitivities.continuous_state;
    REQUIRE(by.size() == 3);
    CHECK(std::abs(by[0] + 4.0 / 27.0) < 1e-9);
    CHECK(std::abs(by[1] - 4.0 / 3.0) < 1e-9);
    CHECK(std::abs(by[2] - 2.0) < 1e-9);
  }
}

TEST_CASE("islands share a parameter of the diagram", "[sensitivity][diagram][islands]") {
  DiagramBuilder builder;
  const ParameterIndex m = builder.declare_parameter("m", 3.0);
  for (const double factor : {1.0, 10.0, 0.0}) {
    const std::string number = std::to_string(static_cast<int>(factor));
    auto& rate = builder.add<Constant>("rate" + number, factor);
    auto& x = builder.add<Integrator>("x" + number, Integrator::Options{});
    builder.connect(rate.output(), x.input());
    if (factor > 0.0)
      builder.compute_parameter(rate, "value", [=](const auto& p) { return factor * p(m) * p(m); });
  }
  const Diagram diagram = builder.build();
  SimulatorOptions options{.islands = true};
  options.sensitivity = {"x1.x", "m"};
  const Results apart_ = simulate(diagram, diagram.create_context(), {0.0, 1.0}, options);
  REQUIRE(apart_.islands.size() == 3);
  for (const IslandResults& island : apart_.islands) CHECK(island.blocks == 2);
  options.islands = false;
  const Results whole = simulate(diagram, diagram.create_context(), {0.0, 1.0}, options);
  const std::vector<double> expected{1.0, 6.0, 0.0, 60.0, 0.0, 0.0};
  for (const Results* results : {&apart_, &whole}) {
    const auto& by = results->sensitivities.continuous_state;
    REQUIRE(by.size() == expected.size());
    for (std::size_t i = 0; i < by.size(); ++i) CHECK(apart(by[i], expected[i]) < 1e-9);
  }
}

TEST_CASE("a kink of a diagram's function is a gap from the start", "[sensitivity][diagram]") {
  const auto gaps = [](double value) {
    DiagramBuilder builder;
    const ParameterIndex m = builder.declare_parameter("m", value);
    auto& one = builder.add<Constant>("one", 1.0);
    auto& x = builder.add<Integrator>("x", Integrator::Options{});
    builder.connect(one.output(), x.input());
    builder.compute_parameter(one, "value", [=](const auto& p) { return abs(p(m)); });
    const Diagram diagram = builder.build();
    const Sensitivities found =
        simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.sensitivity = {"m", "x.x"}})
            .sensitivities;
    CHECK(std::isnan(found.continuous_state[0]) == !found.gaps.empty());
    CHECK(apart(found.continuous_state[1], 1.0) < 1e-12);
    if (!found.gaps.empty()) CHECK(found.gaps[0].time == 0.0);
    if (!found.gaps.empty()) CHECK(found.gaps[0].parameter == "m");
    if (!found.gaps.empty()) CHECK(found.gaps[0].reason.find("'one.value'") != std::string::npos);
    return found.gaps.size();
  };
  CHECK(gaps(0.0) == 1);
  CHECK(gaps(-1.0) == 0);
}

TEST_CASE("a linearisation has columns of a diagram's parameters", "[sensitivity][diagram]") {
  const Diagram diagram = thrown();
  const Context context = diagram.create_context().with_continuous_state({1.0, 0.0});
  const Linearization found = linearize(diagram, context, {.inputs = {"q", {"k", 3.0}, "ball.g"}});
  CHECK(found.B.row(1) == Eigen::RowVector3d(0.0, -2.0, -1.0));
  CHECK(found.u == vec({q0, 3.0, 6.0}));
  CHECK(found.method() == "exact");
  CHECK_THROWS_AS(linearize(diagram, context, {.inputs = {"k", "k"}}), ModelError);
}
