// fit: parameters of closed forms from exact data, events, losses, uncertainty, failures, refusals.
#include <cmath>

#include "saltus/analysis/fit.hpp"
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace fits_test {

/// A ball over a floor at 0.
Leaf thrown(double g = 9.81, double e = 0.8, double height = 1.0) {
  return Leaf("ball", [=](Leaf& leaf) {
    const ParameterIndex gravity = leaf.declare_dynamic_parameter("g", g);
    const ParameterIndex kept = leaf.declare_dynamic_parameter("e", e);
    ContinuousState state{.initial = vec({height, 0.0}), .names = {"height", "velocity"}};
    state.ode = [gravity](const At& at, VectorRef xdot) { xdot << at.x[1], -at.p[gravity]; };
    leaf.declare_continuous_state(state);
    leaf.declare_continuous_state_output("state");
    leaf.declare_zero_crossing({.name = "bounce",
                                .guard = [](const At& at) { return at.x[0]; },
                                .reset_map =
                                    [kept](const At& at, Next& next) {
                                      next.set_continuous_state({at.x[0], -at.p[kept] * at.x[1]});
                                    },
                                .direction = Direction::positive_then_non_positive});
  });
}

/// x' = -k x; y = a b x, so that only the product of a and b can be seen; c is not used.
Leaf decay(double k_value = 1.0) {
  return Leaf("decay", [=](Leaf& leaf) {
    const ParameterIndex k = leaf.declare_dynamic_parameter("k", k_value);
    const ParameterIndex a = leaf.declare_dynamic_parameter("a", 1.0);
    const ParameterIndex b = leaf.declare_dynamic_parameter("b", 1.0);
    leaf.declare_dynamic_parameter("c", 1.0);
    leaf.declare_continuous_state(
        {.initial = vec({1.0}), .ode = [k](const At& at) { return -at.p[k] * at.x[0]; }});
    leaf.declare_output_port(
        {.name = "y", .calc = [a, b](const At& at) { return at.p[a] * at.p[b] * at.x[0]; }});
  });
}

/// [s] t_k = t1 (1 + 2 sum of e^j for 0 < j < k), t1 = sqrt(2 height / g).
std::vector<double> impacts(int count, double g = 9.81, double e = 0.8, double height = 1.0) {
  std::vector<double> times;
  const double first = std::sqrt(2.0 * height / g);
  double sum = 1.0;
  for (int k = 1; k <= count; ++k) {
    times.push_back(first * sum);
    sum += 2.0 * std::pow(e, k);
  }
  return times;
}

/// [m] Of the ball, by its parabolas.
double height_at(double t, double g = 9.81, double e = 0.8, double height = 1.0) {
  const std::vector<double> hits = impacts(40, g, e, height);
  int k = 0;
  while (k < 40 && nth(hits, k) <= t) ++k;
  if (k == 0) return height - 0.5 * g * t * t;
  const double s = t - nth(hits, k - 1), v = std::sqrt(2.0 * g * height) * std::pow(e, k);
  return v * s - 0.5 * g * s * s;
}

std::vector<double> spread(double first, double last, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(first + (last - first) * i / (count - 1));
  return times;
}

template <class Value>
Experiment measured(const std::string& name, const std::vector<double>& times, Value value) {
  Eigen::VectorXd values(static_cast<Index>(times.size()));
  for (Index i = 0; i < values.size(); ++i) values[i] = value(nth(times, i));
  return {.time = times, .signals = {{.name = name, .values = values}}};
}

FitOptions tight() {
  FitOptions options;
  options.simulation.rtol = 1e-11, options.simulation.atol = 1e-12;
  return options;
}

FitResult fitted(const System& system, const Experiment& data,
                 const std::vector<FreeValue>& parameters, const FitOptions& options = {}) {
  return fit(system, system.create_context(), data, parameters, options);
}

std::string refusal(const System& system, const Experiment& data,
                    const std::vector<FreeValue>& parameters, const FitOptions& options = {}) {
  return message<ModelError>([&] { fitted(system, data, parameters, options); });
}

const std::vector<FreeValue> g_and_e{{.name = "g", .start = 9.0},
                                     {.name = "e", .lower = 0.5, .upper = 1.0}};

TEST_CASE("g and e of a ball from exact heights", "[fit]") {
  const Leaf ball = thrown();
  const Experiment data =
      measured("height", spread(0.05, 1.0, 20), [](double t) { return height_at(t, 9.8, 0.8); });
  for (const Method method : {Method::dopri5, Method::dop853, Method::radau, Method::bdf}) {
    INFO(to_string(method));
    FitOptions options = tight();
    options.simulation.ode_solver_method = method;
    const FitResult found = fitted(ball, data, g_and_e, options);
    CHECK(found.success());
    // the error of a run is near rtol, and grows by one bounce; bdf sums those of some hundred steps
    CHECK_THAT(found.value("g"), WithinRel(9.8, 1e-8));
    CHECK_THAT(found.value("e"), WithinRel(0.8, 1e-8));
    CHECK(found.failures == 0);
    CHECK(found.warnings.empty());
  }
}

TEST_CASE("event times are data, and so is the Zeno time", "[fit]") {
  const Leaf ball = thrown(9.0, 0.8, 10.0);
  const Experiment seen{.events = {{.name = "bounce", .times = impacts(6, 9.81, 0.9, 10.0)}}};
  const FitResult found = fitted(ball, seen, g_and_e, tight());
  CHECK(found.success());
  CHECK_THAT(found.value("g"), WithinRel(9.81, 1e-8));
  CHECK_THAT(found.value("e"), WithinRel(0.9, 1e-8));
  CHECK_THAT(found.jacobian(5, 1), WithinRel(32.630498888252205, 1e-7));  // dt6/de
  // t1 (1 + e) / (1 - e) at e = 0.9; dt/de = 286 s, and the prediction is right to some 1e-7 s
  const Leaf other = thrown(9.81, 0.85, 10.0);
  const Experiment zeno{
      .events = {{.name = "bounce", .times = {27.12901933561423}, .kind = EventKind::zeno_enter}}};
  FitOptions options = tight();
  options.simulation.rtol = 1e-12, options.simulation.atol = 1e-14;
  const FitResult rest = fitted(other, zeno, {{.name = "e", .lower = 0.5, .upper = 0.99}}, options);
  CHECK(rest.success());
  CHECK_THAT(rest.value("e"), WithinAbs(0.9, 1e-8));
  CHECK_THAT(rest.jacobian(0, 0), WithinRel(285.56862458541303, 1e-5));
}

TEST_CASE("an event that the run does not have is at its end, or at its Zeno point", "[fit]") {
  const std::vector<double> times = impacts(3);
  const double end = 0.5 * (times[1] + times[2]);
  FitOptions options;
  options.t_span = TimeSpan{0.0, end}, options.max_nfev = 1;
  const Experiment cut{.events = {{.name = "bounce", .times = {times[0], times[1], end - 0.01}}}};
  const FitResult found =
      fitted(thrown(), cut, {{.name = "e", .lower = 0.7, .upper = 0.9}}, options);
  CHECK(found.status == SearchStatus::max_nfev);
  CHECK_THAT(found.compared[0].model[2], WithinRel(end, 1e-9));
  CHECK(found.jacobian(2, 0) == 0.0);
  options.t_span.reset();
  const Experiment many{.events = {{.name = "bounce", .times = impacts(10, 9.81, 0.5)}}};
  const FitResult rest =
      fitted(thrown(9.81, 0.01), many, {{.name = "e", .start = 0.01, .lower = 0.0, .upper = 1.0}},
             options);
  CHECK_THAT(rest.compared[0].model[9], WithinAbs(impacts(1)[0] * 1.01 / 0.99, 1e-6));
}

TEST_CASE("logarithms, start values, and several runs with parameters of their own", "[fit]") {
  const Leaf system = decay();
  FitOptions options;
  options.simulation.rtol = 1e-12, options.simulation.atol = 1e-14;
  const FitResult slow = fitted(
      system, measured("y", spread(0.0, 2.0, 9), [](double t) { return std::exp(-1e-3 * t); }),
      {{.name = "k", .start = 10.0, .log = true}}, options);
  CHECK(slow.success());
  CHECK_THAT(slow.value("k"), WithinRel(1e-3, 1e-6));  // y - 1 is known to 1e-12 of 1e-3
  CHECK(slow.confidence(0.999)[0].first > 0.0);
  const FitResult two =
      fitted(system,
             measured("y", spread(0.0, 1.0, 11), [](double t) { return 3.0 * std::exp(-0.7 * t); }),
             {{.name = "k"}, {.name = "x[0]"}});
  CHECK_THAT(two.value("k"), WithinRel(0.7, 1e-7));
  CHECK_THAT(two.value("x[0]"), WithinRel(3.0, 1e-7));
  CHECK_THAT(two.contexts[0].continuous_state()[0], WithinRel(3.0, 1e-7));
  Experiment known = measured("height", spread(0.05, 1.2, 24),
                              [](double t) { return height_at(t, 9.81, 0.7, 2.0); });
  known.values = {{"x[0]", 2.0}};
  const Experiment guessed{.events = {{.name = "bounce", .times = impacts(3, 9.81, 0.7, 1.5)}},
                           .free = {{.name = "height", .lower = 0.5, .upper = 3.0}},
                           .name = "low"};
  const Leaf ball = thrown();
  const FitResult both =
      fit(ball, ball.create_context(), std::vector<Experiment>{known, guessed},
          {{.name = "e", .lower = 0.1, .upper = 1.0}, {.name = "g", .start = 9.0}});
  CHECK(both.success());
  CHECK_THAT(both.value("e"), WithinRel(0.7, 1e-6));
  CHECK_THAT(both.value("g"), WithinRel(9.81, 1e-6));
  CHECK_THAT(both.value("low: height"), WithinRel(1.5, 1e-6));
  CHECK(both.jacobian.col(2).head(24).isZero(0.0));  // the height of one run moves no other
}

TEST_CASE("the covariance is that of a linear model", "[fit]") {
  // y = a x with x = 1 at one time: a = mean of the data, its variance sigma^2 / n
  const Leaf system = decay(0.0);
  Experiment data{.time = {0.0, 0.5, 1.0, 1.5}, .signals = {{.name = "y"}}};
  data.signals[0].values = vec({1.9, 2.1, 2.2, 1.8});
  const FitResult scaled = fitted(system, data, {{.name = "a"}});
  CHECK_THAT(scaled.value("a"), WithinRel(2.0, 1e-8));
  CHECK_THAT(scaled.covariance(0, 0), WithinRel(0.1 / 3.0 / 4.0, 1e-7));
  // Student's quantile of 3 degrees of freedom at 97.5 %
  CHECK_THAT(scaled.confidence()[0].second - 2.0,
             WithinRel(3.182446305284263 * std::sqrt(0.1 / 12.0), 1e-6));
  FitOptions absolute;
  absolute.absolute_sigma = true;
  data.signals[0].sigma = Eigen::MatrixXd::Constant(1, 1, 0.2);
  const FitResult known = fitted(system, data, {{.name = "a"}}, absolute);
  CHECK_THAT(known.standard_errors()[0], WithinRel(0.1, 1e-7));
  CHECK_THAT(known.confidence()[0].second - 2.0, WithinRel(0.1959963984540054, 1e-6));
  data.signals[0].values(1, 0) = not_a_number;
  const FitResult fewer = fitted(system, data, {{.name = "a"}}, absolute);
  CHECK(fewer.missing == 1);
  CHECK_THAT(fewer.value("a"), WithinRel(5.9 / 3.0, 1e-8));
}

TEST_CASE("what the data do not determine is said", "[fit]") {
  const Leaf system = decay();
  const Experiment data =
      measured("y", spread(0.0, 1.0, 9), [](double t) { return 2.0 * std::exp(-0.5 * t); });
  const FitResult product = fitted(system, data, {{.name = "k"}, {.name = "a"}, {.name = "b"}});
  CHECK(product.success());
  CHECK(std::isinf(product.standard_errors()[1]));
  CHECK(std::isfinite(product.standard_errors()[0]));
  REQUIRE(!product.warnings.empty());
  CHECK(contains(product.warnings[0], "a combination of 'a' and 'b' only"));
  const FitResult unused = fitted(system, data, {{.name = "k"}, {.name = "a"}, {.name = "c"}});
  CHECK(contains(unused.warnings[0], "do not determine 'c'"));
}

TEST_CASE("an outlier counts less with a loss", "[fit]") {
  const Leaf system = decay(0.0);
  Experiment data{.time = spread(0.0, 1.0, 11), .signals = {{.name = "y"}}};
  data.signals[0].values = Eigen::VectorXd::Constant(11, 2.0);
  data.signals[0].values(5, 0) = 50.0;
  CHECK_THAT(fitted(system, data, {{.name = "a"}}).value("a"), WithinRel(70.0 / 11.0, 1e-7));
  for (const Loss loss : {Loss::soft_l1, Loss::huber, Loss::cauchy, Loss::arctan}) {
    INFO(to_string(loss));
    FitOptions options;
    options.loss = loss, options.f_scale = 0.1;
    const FitResult found = fitted(system, data, {{.name = "a", .start = 2.5}}, options);
    CHECK(found.success());
    // ten residuals r = a - 2 and one of 48: the sum of rho' r is zero, |rho'(48) 48| <= 0.1
    CHECK_THAT(found.value("a"), WithinAbs(2.0, 0.0101));
  }
}

TEST_CASE("a run that fails shortens the step, and is counted", "[fit]") {
  // the flow is not finite below k = 0.3; a full step from 3 goes there
  const Leaf system("root", [](Leaf& leaf) {
    const ParameterIndex k = leaf.declare_dynamic_parameter("k", 3.0);
    leaf.declare_continuous_state({.initial = vec({1.0}), .ode = [k](const At& at) {
                                     return -std::sqrt(at.p[k] - 0.3) * at.x[0];
                                   }});
    leaf.declare_continuous_state_output("y");
  });
  const double rate = std::sqrt(0.31 - 0.3);
  const FitResult found = fitted(
      system, measured("y", spread(0.1, 3.0, 20), [=](double t) { return std::exp(-rate * t); }),
      {{.name = "k"}});
  CHECK(found.success());
  CHECK_THAT(found.value("k"), WithinRel(0.31, 1e-6));
  CHECK(found.failures > 0);
  CHECK(contains(found.warnings.at(0), "evaluations failed; the first: "));
  const std::string failed = message<SimulationError>([&] {
    fitted(system, measured("y", {0.1, 0.2}, [](double) { return 1.0; }),
           {{.name = "k", .start = 0.1}});
  });
  CHECK(contains(failed, "the run with the start values failed"));
}

TEST_CASE("a system without derivatives is fitted by differences, and several starts", "[fit]") {
  DiagramBuilder builder;
  auto& source = builder.add<Constant>("rate", 1.0);
  auto& late = builder.add<TransportDelay>("late", 0.25);
  auto& state = builder.add<Integrator>("state");
  builder.connect(source.output(), late.input());
  builder.connect(late.output(), state.input());
  builder.export_output(state.output(), "y");
  const Diagram system = builder.build();
  const Experiment data =
      measured("y", spread(0.5, 2.0, 7), [](double t) { return 3.0 * (t - 0.25); });
  FitOptions options;
  options.starts = 3;
  const FitResult found =
      fitted(system, data, {{.name = "rate.value", .lower = 0.0, .upper = 10.0}}, options);
  CHECK(found.success());
  CHECK_THAT(found.value("rate.value"), WithinRel(3.0, 1e-5));
  CHECK(contains(found.warnings.at(0), "differences of runs replace missing derivatives"));
  CHECK(found.starts.size() == 3);
}

TEST_CASE("an interrupt ends a fit with the best values so far", "[fit]") {
  FitOptions options;
  int seen = 0;
  options.progress = [&](const FitProgress& now) { seen = now.evaluations; };
  options.simulation.interrupt = [&] { return seen >= 2; };
  const FitResult found = fitted(
      thrown(), measured("height", spread(0.05, 1.0, 20), [](double t) { return height_at(t); }),
      {{.name = "g", .start = 7.0}}, options);
  CHECK(found.status == SearchStatus::interrupted);
  CHECK(found.evaluations == 2);
}

TEST_CASE("bad data and arguments of fit are refused by name", "[fit]") {
  const Leaf ball = thrown();
  const Experiment data =
      measured("height", spread(0.05, 1.0, 20), [](double t) { return height_at(t); });
  CHECK(contains(refusal(ball, data, {{.name = "gg"}}), "did you mean 'g'?"));
  CHECK(contains(refusal(ball, data, {}), "expected at least one"));
  CHECK(contains(refusal(ball, data, {{.name = "height"}, {.name = "x[0]"}}), "are one value"));
  CHECK(contains(refusal(ball, data, {{.name = "g", .start = 2.0, .upper = 1.0}}),
                 "is outside of the bounds"));
  Experiment wrong = data;
  wrong.signals[0].name = "hight";
  CHECK(contains(refusal(ball, wrong, g_and_e), "unknown signal 'hight'; did you mean 'height'?"));
  wrong.signals[0].name = "state";
  CHECK(contains(refusal(ball, wrong, g_and_e), "expected 2 numbers for each of 20 times"));
  wrong.signals[0].name = "state[2]";
  CHECK(contains(refusal(ball, wrong, g_and_e), "the signal has 2 entries"));
  wrong = data, wrong.signals.push_back(data.signals[0]);
  wrong.signals[1].port = ball.output("velocity");
  CHECK(contains(refusal(ball, wrong, g_and_e), "'height' names two outputs"));
  wrong = data, wrong.signals[0].values(3, 0) = infinite;
  CHECK(contains(refusal(ball, wrong, g_and_e), "write NaN for a missing value"));
  wrong = data, wrong.time[0] = not_a_number;
  CHECK(contains(refusal(ball, wrong, g_and_e), "expected finite times"));
  wrong = data, wrong.time[0] = -1.0;
  CHECK(contains(refusal(ball, wrong, g_and_e), "is outside of the run"));
  wrong = data, wrong.signals[0].values.setConstant(not_a_number);
  CHECK(contains(refusal(ball, wrong, g_and_e), "found 0, without 20 that are NaN"));
  CHECK(
      contains(refusal(ball, {.time = {0.1}, .signals = {{.name = "height", .values = vec({1.0})}}},
                       g_and_e),
               "expected at least 2 data, as many as parameters, found 1"));
  wrong = data, wrong.signals[0].sigma = Eigen::MatrixXd::Constant(1, 1, -1.0);
  CHECK(contains(refusal(ball, wrong, g_and_e), "expected standard deviations above 0"));
  CHECK(contains(refusal(ball, {.events = {{.name = "bonce", .times = {0.4, 1.0}}}}, g_and_e),
                 "did you mean 'bounce'?"));
  CHECK(contains(refusal(ball, {.events = {{.name = "bounce", .times = {1.0, 0.4}}}}, g_and_e),
                 "expected increasing times"));
  FitOptions options;
  options.absolute_sigma = true;
  CHECK(contains(refusal(ball, data, g_and_e, options), "there is none of 'height'"));
  options = {}, options.simulation.save_at = {1.0};
  CHECK(contains(refusal(ball, data, g_and_e, options), "the option 'save_at' is set by it"));
  options = {}, options.starts = 2;
  CHECK(contains(refusal(ball, data, g_and_e, options), "'g' has none"));
}

// The numbers of the Python module, with Throw of tests/python/fit/fit_scenes.py:
//   t = np.linspace(0.05, 1.0, 20)
//   f = saltus.fit(Throw(), {"time": t, "height": heights(t, 9.8, 0.8) + 0.01 * np.cos(40.0 * t)},
//                  {"g": 9.0, "e": (0.5, 1.0)}, rtol=1e-11, atol=1e-12, ftol=1e-15, xtol=1e-15)
//   print(f.values, f.standard_errors, f.cost, f.confidence())
TEST_CASE("fit has the values that the Python module has", "[fit]") {
  FitOptions options = tight();
  options.ftol = options.xtol = 1e-15;
  const FitResult found =
      fitted(thrown(),
             measured("height", spread(0.05, 1.0, 20),
                      [](double t) { return height_at(t, 9.8, 0.8) + 0.01 * std::cos(40.0 * t); }),
             g_and_e, options);
  CHECK(found.success());
  // the least cost is known to 1e-11 of itself, so a parameter to the root of that of its error
  CHECK_THAT(found.value("g"), WithinAbs(9.798497060696796, 1e-6));
  CHECK_THAT(found.value("e"), WithinAbs(0.7998492828436387, 1e-7));
  CHECK_THAT(found.standard_errors()[0], WithinRel(0.031105371883914906, 1e-5));
  CHECK_THAT(found.standard_errors()[1], WithinRel(0.0015259699278114937, 1e-5));
  CHECK_THAT(found.cost, WithinRel(0.0004915180955067003, 1e-9));
  CHECK_THAT(found.confidence()[0].first, WithinAbs(9.733147099335985, 1e-6));
}

}  // namespace fits_test
