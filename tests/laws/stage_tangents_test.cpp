// The derivatives of explicit steps are those of the discrete steps, with their sizes frozen.
#include <cmath>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinAbs;

namespace stage_tangents {
namespace {

/// Steps of h from the begin to the end: a tolerance that loose refuses none of them.
SimulatorOptions steps_of(double h, Method method, std::vector<std::string> by = {}) {
  SimulatorOptions options{.rtol = 0.1, .atol = 1.0, .ode_solver_method = method};
  options.max_minor_step_size = h, options.first_step = h, options.dense_output = true;
  options.sensitivity = std::move(by);
  return options;
}

/// x' = lambda x
Leaf decay(double lambda, double start) {
  return Leaf("decay", [=](Leaf& l) {
    l.declare_continuous_state({.initial = vec({start}), .formula = Formula([=](const auto& at) {
                                                           return lambda * at.x(0);
                                                         })});
  });
}

/// A pendulum with friction, y'' = -w sin y - c y'.
class Pendulum final : public Leaf {
 public:
  Pendulum()
      : Leaf("pendulum", [](Leaf& l) {
          const ParameterIndex w = l.declare_dynamic_parameter("w", 1.3);
          const ParameterIndex c = l.declare_dynamic_parameter("c", 0.2);
          l.declare_continuous_state({.initial = vec({2.0, 0.1}),
                                      .ode = equations<2>([=](const auto& at, auto& xdot) {
                                        using std::sin;
                                        xdot[0] = at.x(1);
                                        xdot[1] = -at.p(w, 0) * sin(at.x(0)) - at.p(c, 0) * at.x(1);
                                      })});
        }) {}
};

const std::vector<std::string> all = {"w", "c", "x[0]", "x[1]"};

const Pendulum& pendulum() {
  static const Pendulum all_runs;
  return all_runs;
}

/// The run with its k-th value moved by `shift`.
Results moved(Index k, double shift, double h, Method method, std::vector<std::string> by = {}) {
  Context start = pendulum().create_context();
  Eigen::VectorXd x = start.continuous_state();
  if (k >= 2) x[k - 2] += shift;
  if (k < 2) start = start.with_parameter(nth(all, k), start.parameter(nth(all, k))[0] + shift);
  return simulate(pendulum(), start.with_continuous_state(x), {0.0, 3.0},
                  steps_of(h, method, std::move(by)));
}

/// Differences of order four of two pairs of runs, each of which has the same steps.
template <class Read>
Eigen::VectorXd difference(Index k, double h, Method method, const Read& read) {
  const double u = 1e-3;
  const auto pair = [&](double shift) -> Eigen::VectorXd {
    return (read(moved(k, shift, h, method)) - read(moved(k, -shift, h, method))) / (2.0 * shift);
  };
  return (4.0 * pair(u) - pair(2.0 * u)) / 3.0;
}

/// y'' = -sin y, with the output y^2, which is no entry of the state.
const Leaf& swing() {
  static const Leaf leaf("swing", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({2.0, 0.1}), .ode = equations<2>([](const auto& at, auto& xdot) {
                                       using std::sin;
                                       xdot[0] = at.x(1);
                                       xdot[1] = -sin(at.x(0));
                                     })});
    l.declare_output_port(
        {.name = "square", .calc = [](const At& at) { return at.x[0] * at.x[0]; }});
  });
  return leaf;
}

}  // namespace

TEST_CASE("the tangent of a linear step is the stability function of the method",
          "[sensitivity][stages]") {
  const double z = -0.75;
  const int steps = 8;
  const auto run = [&](Method method, double start) {
    const Leaf leaf = decay(-3.0, start);
    return simulate(leaf, leaf.create_context(), {0.0, 2.0}, steps_of(0.25, method, {"x[0]"}));
  };
  // R(z) of dopri5: the coefficients of its order, and 1/600 (Hairer, Wanner II, IV.2).
  const double r =
      1.0 + z * (1.0 + z / 2 * (1.0 + z / 3 * (1.0 + z / 4 * (1.0 + z / 5 * (1.0 + z / 5)))));
  const Results low = run(Method::dopri5, 0.7);
  REQUIRE(low.statistics.steps == steps);
  const double power = std::pow(r, steps);
  CHECK_THAT(low.sensitivities.continuous_state[0], WithinAbs(power, 64.0 * 2.3e-16 * power));
  CHECK(std::abs(power - std::exp(steps * z)) > 1e-6);  // the equation itself has another solution
  // S obeys the equation of x, so S = x(t) / x(0) by each method: a rounding or two a stage.
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic);
  const Results any = run(method, 0.5);
  const double quotient = any.context.continuous_state()[0] / 0.5;
  CHECK_THAT(any.sensitivities.continuous_state[0], WithinAbs(quotient, 1e-14 * quotient));
}

// The fifth derivative of the run by a value is below 100: differences miss by 4 u^4 100 / 30 =
// 1e-11 and by eps / u = 1e-12; the size of the derivatives is up to 5.
TEST_CASE("derivatives are those of the discrete steps, at their ends and inside",
          "[sensitivity][stages][dense]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  const double h = method == Method::dopri5 ? 0.375 : 1.0;
  INFO("method " << method);
  const Results run = moved(0, 0.0, h, method, all), fine = moved(0, 0.0, 0.01, method, all);
  REQUIRE(run.statistics.steps == static_cast<int>(3.0 / h));
  double off = 0.0;
  for (const double t : {0.11, 1.3, 2.0, 2.77, 3.0}) {
    const auto found = run.sensitivities_at(t).continuous_state;
    off = std::max(off, (found - fine.sensitivities_at(t).continuous_state).cwiseAbs().maxCoeff());
    for (Index k = 0; k < 4; ++k) {
      INFO("t = " << t << ", by " << nth(all, k));
      const auto read = [t](const Results& of) -> Eigen::VectorXd {
        return of.at(t).continuous_state;
      };
      const Eigen::VectorXd by = difference(k, h, method, read);
      CHECK((found.col(k) - by).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
  CHECK(off > 1e-6);  // they are not those of the solution
}

TEST_CASE("the order of the derivatives is that of the method", "[sensitivity][stages][order]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  const double order = method == Method::dopri5 ? 5.0 : 8.0,
               h = method == Method::dopri5 ? 0.1 : 0.5;
  INFO("method " << method);
  const Results exact = moved(0, 0.0, 0.02, Method::dop853, all);
  const auto error = [&](double length) {
    const Results run = moved(0, 0.0, length, method, all);
    double most = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
      most = std::max(most, std::abs(run.sensitivities.continuous_state[i] -
                                     exact.sensitivities.continuous_state[i]));
    return most;
  };
  const double observed = std::log2(error(h) / error(0.5 * h));
  CHECK(observed > order - 0.7);
  CHECK(observed < order + 1.5);
}

TEST_CASE("a derivative that moves while the state rests is as good as the tolerance",
          "[sensitivity][stages]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  const Leaf leaf = decay(-3.0, 0.0);
  SimulatorOptions options{.rtol = 1e-8, .atol = 1e-10, .ode_solver_method = method};
  options.dense_output = true, options.sensitivity = {"x[0]"};
  const Results run = simulate(leaf, leaf.create_context(), {0.0, 5.0}, options);
  // Ten estimates of one tolerance a step.
  for (const double t : {0.1, 1.0, 2.5, 5.0})
    CHECK_THAT(run.sensitivities_at(t).continuous_state(0, 0), WithinAbs(std::exp(-3.0 * t), 1e-7));
}

// The rows between the ends of steps are made one by one. d(y^2) = 2 y dy; differences have 1e-10.
TEST_CASE("rows inside the steps have the derivatives of the state there",
          "[sensitivity][stages]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853);
  const auto [rtol, dense] =
      GENERATE(table<double, bool>({{1e-3, false}, {1e-3, true}, {1e-8, false}}));
  INFO("method " << method << ", rtol " << rtol << ", dense " << dense);
  SimulatorOptions options{.rtol = rtol, .atol = rtol, .ode_solver_method = method};
  options.sensitivity = {"x[0]", "x[1]"}, options.save_at = {0.1, 0.2, 0.9, 1.7, 2.2, 2.3};
  options.recorded_signals = {{"square", swing().output(0)}};
  options.dense_output = dense;
  const Results rows = simulate(swing(), swing().create_context(), {0.0, 3.0}, options);
  options.dense_output = true;
  const Results all_times = simulate(swing(), swing().create_context(), {0.0, 3.0}, options);
  REQUIRE(rows.time == all_times.time);
  for (std::size_t i = 0; i < rows.time.size(); ++i) {
    const double y = all_times.at(rows.time[i]).continuous_state[0];
    const Eigen::MatrixXd of = all_times.sensitivities_at(rows.time[i]).continuous_state;
    for (std::size_t k = 0; k < 2; ++k)
      CHECK_THAT(rows.sensitivities.signals[0][2 * i + k],
                 WithinAbs(2.0 * y * of(0, static_cast<Index>(k)), 1e-9));
  }
}

TEST_CASE("with and without derivatives an explicit run has the same bits",
          "[sensitivity][stages]") {
  const auto method = GENERATE(Method::dopri5, Method::dop853, Method::automatic);
  const double rtol = GENERATE(1e-3, 1e-6, 1e-10);
  SimulatorOptions options{.rtol = rtol, .ode_solver_method = method};
  options.dense_output = true;
  const Results alone = simulate(pendulum(), pendulum().create_context(), {0.0, 30.0}, options);
  options.sensitivity = all;
  const Results with = simulate(pendulum(), pendulum().create_context(), {0.0, 30.0}, options);
  CHECK(alone.context.continuous_state() == with.context.continuous_state());
  CHECK(alone.statistics.steps == with.statistics.steps);
  for (const double t : {0.3, 1.7, 7.0, 23.1})
    CHECK(alone.at(t).continuous_state == with.at(t).continuous_state);
}

}  // namespace stage_tangents
