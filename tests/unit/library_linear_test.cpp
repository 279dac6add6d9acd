// LTISystem, TransferFunction, Derivative: closed forms of their responses, feedthrough, starts,
// balance, and what is refused.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/library/derivative.hpp"
#include "saltus/library/detail/realisation.hpp"
#include "saltus/library/lti_system.hpp"
#include "saltus/library/transfer_function.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

Eigen::VectorXd polynomial(std::initializer_list<double> coefficients) {
  return Value(coefficients).values;
}

const auto unit_step = fed_by<Constant>(1.0);
const auto no_input = fed_by<Constant>(0.0);
const std::vector<double> times{0.3, 1.0, 2.5};

/// The response of a transfer function to a constant 1, at `times`.
Numbers step_response(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator) {
  return BlockRun<TransferFunction>(unit_step, numerator, denominator).at(times);
}

void check_near(const Numbers& found, double (*exact)(double)) {
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(found[i], WithinAbs(exact(times[i]), solver_tolerance));
}

bool through(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator) {
  return !Bench<TransferFunction>({1.0}, numerator, denominator).node().needs.empty();
}

}  // namespace

TEST_CASE("step responses of transfer functions are their closed forms", "[library][linear]") {
  check_near(step_response(polynomial({1.0}), polynomial({1.0, 1.0})),
             [](double t) { return 1.0 - std::exp(-t); });
  check_near(step_response(polynomial({3.0}), polynomial({2.0, 0.0})),
             [](double t) { return 1.5 * t; });
  check_near(step_response(polynomial({1.0}), polynomial({1.0, 0.0, 4.0})),
             [](double t) { return 0.25 * (1.0 - std::cos(2.0 * t)); });
  check_near(step_response(polynomial({1.0, 3.0}), polynomial({1.0, 3.0, 2.0})),
             [](double t) { return 1.5 - 2.0 * std::exp(-t) + 0.5 * std::exp(-2.0 * t); });
}

TEST_CASE("equal degrees feed the input through, others do not", "[library][linear]") {
  check_near(step_response(polynomial({2.0, 1.0}), polynomial({1.0, 1.0})),
             [](double t) { return 1.0 + std::exp(-t); });
  check_near(step_response(polynomial({3.0}), polynomial({2.0})), [](double) { return 1.5; });
  CHECK(through(polynomial({2.0, 1.0}), polynomial({1.0, 1.0})));
  CHECK_FALSE(through(polynomial({1.0}), polynomial({1.0, 1.0})));
  CHECK_FALSE(through(polynomial({0.0, 1.0}), polynomial({1.0, 1.0})));
}

TEST_CASE("an improper transfer function is refused", "[library][linear]") {
  const auto made = [](std::initializer_list<double> numerator,
                       std::initializer_list<double> denominator) {
    return model_error(
        [&] { TransferFunction("g", polynomial(numerator), polynomial(denominator)); });
  };
  CHECK(made({1.0, 0.0}, {5.0}) ==
        "block 'g': the numerator has the degree 1 in s, the denominator 0; expected a proper "
        "transfer function: multiply the denominator by a fast pole");
  CHECK(contains(made({1.0}, {0.0, 0.0}), "the denominator is 0"));
  CHECK(contains(made({0.0}, {1.0, 1.0}), "the numerator is 0"));
  CHECK(contains(made({}, {1.0}), "the numerator is 0"));
}

/// Free motions from the two kinds of start, of a damped oscillator s^2 + 2 s + 5, with a numerator
/// that reads both states.
TEST_CASE("a transfer function starts from its states or in a steady state", "[library][linear]") {
  using Options = TransferFunction::Options;
  const Eigen::VectorXd numerator = polynomial({1.0, 3.0}),
                        denominator = polynomial({1.0, 2.0, 5.0});
  const auto free = BlockRun<TransferFunction>(no_input, numerator, denominator,
                                               Options{.initial_state = polynomial({1.0, -1.0})});
  // v = e^-t cos 2t has v(0) = 1, v'(0) = -1; y = v' + 3 v.
  check_near(free.at(times), [](double t) {
    return std::exp(-t) * (2.0 * std::cos(2.0 * t) - 2.0 * std::sin(2.0 * t));
  });
  const auto steady = BlockRun<TransferFunction>(fed_by<Constant>(5.0 / 3.0 * 7.0), numerator,
                                                 denominator, Options{.initial_output = 7.0});
  check_near(steady.at(times), [](double) { return 7.0; });
  const auto with_feedthrough =
      BlockRun<TransferFunction>(fed_by<Constant>(2.0 * 7.0), polynomial({3.0, 1.0}),
                                 polynomial({1.0, 2.0}), Options{.initial_output = 7.0});
  check_near(with_feedthrough.at(times), [](double) { return 7.0; });
}

TEST_CASE("a start that does not fit is refused", "[library][linear]") {
  using Options = TransferFunction::Options;
  const auto made = [](const Options& options, std::initializer_list<double> denominator) {
    return model_error(
        [&] { TransferFunction("g", polynomial({1.0}), polynomial(denominator), options); });
  };
  CHECK(contains(made({.initial_state = polynomial({1.0})}, {1.0, 1.0, 1.0}),
                 "initial_state has 1 values; expected 2"));
  CHECK(contains(made({.initial_output = 1.0}, {1.0, 0.0}), "a gain at s = 0 that is finite"));
  CHECK(contains(made({.initial_state = polynomial({1.0}), .initial_output = 1.0}, {1.0, 1.0}),
                 "give one of them"));
}

/// Time constants from 1 us to 1 ms: the coefficients of the companion form reach 1e18, so a
/// solver's absolute tolerance would mean nothing for states that are not balanced.
TEST_CASE("the companion form is balanced", "[library][linear]") {
  const Eigen::VectorXd denominator = polynomial({1e-15, 1.111e-9, 1.111e-4, 1.0});
  const auto p = detail::proper("g", "s", polynomial({1.0}), denominator);
  const Eigen::VectorXd scales = detail::balance(p), a = denominator / denominator[0];
  double largest = 0.0, smallest = HUGE_VAL;  // of the couplings between states
  for (Index i = 0; i + 1 < 3; ++i) {
    const double up = scales[i + 1] / scales[i], down = scales[i] / scales[2] * a[3 - i];
    largest = std::max({largest, up, down});
    smallest = std::min({smallest, up, down});
  }
  CHECK(largest < 1e12);  // 1e15 without balance
  CHECK(smallest > 1e2);  // 1 without
  for (const double scale : scales) CHECK(std::log2(scale) == std::round(std::log2(scale)));
}

TEST_CASE("the coefficients of a transfer function are parameters", "[library][linear]") {
  const BlockRun<TransferFunction> scene(unit_step, polynomial({1.0}), polynomial({1.0, 1.0}));
  const auto context = scene.diagram.create_context()
                           .with_parameter("block.numerator", 4.0)
                           .with_parameter("block.denominator", Eigen::Vector2d(1.0, 2.0));
  const auto results = simulate(scene.diagram, context, {0.0, 1.0}, precise());
  const double x = results.context.continuous_state()[0] * scene.block->scales()[0];
  CHECK_THAT(4.0 * x, WithinAbs(2.0 * (1.0 - std::exp(-2.0)), solver_tolerance));
}

TEST_CASE("LTISystem is x' = A x + B u, y = C x + D u", "[library][linear]") {
  const LTISystem::Matrices rotation{.A = Eigen::Matrix2d{{0.0, 1.0}, {-1.0, 0.0}},
                                     .B = Eigen::Matrix2d::Identity(),
                                     .C = Eigen::RowVector2d(1.0, 2.0),
                                     .D = Eigen::RowVector2d(0.0, 10.0)};
  const auto inputs = fed_by<Constant>(Value{0.0, 1.0});
  const BlockRun<LTISystem> scene(inputs, rotation,
                                  LTISystem::Options{.initial_state = Eigen::Vector2d(1.0, 0.0)});
  // x_1 = 1, a fixed point of x_1'' = 1 - x_1 with x_1' = 0
  check_near(scene.at(times), [](double) { return 11.0; });
  const BlockRun<LTISystem> free(fed_by<Constant>(Value{0.0, 0.0}), rotation,
                                 LTISystem::Options{.initial_state = Eigen::Vector2d(1.0, 0.0)});
  check_near(free.at(times), [](double t) { return std::cos(t) - 2.0 * std::sin(t); });
}

TEST_CASE("an LTISystem has feedthrough only with a D that is not 0", "[library][linear]") {
  const auto needs = [](std::optional<Eigen::MatrixXd> D) {
    const LTISystem::Matrices matrices{.A = Eigen::MatrixXd::Constant(1, 1, -1.0),
                                       .B = Eigen::MatrixXd::Constant(1, 1, 1.0),
                                       .C = Eigen::MatrixXd::Constant(1, 1, 1.0),
                                       .D = std::move(D)};
    return !Bench<LTISystem>({1.0}, matrices).node().needs.empty();
  };
  CHECK_FALSE(needs({}));
  CHECK_FALSE(needs(Eigen::MatrixXd::Zero(1, 1)));
  CHECK(needs(Eigen::MatrixXd::Constant(1, 1, 2.0)));
}

TEST_CASE("matrices that do not fit are refused with their sizes", "[library][linear]") {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1), wide = Eigen::MatrixXd::Ones(1, 2);
  CHECK(model_error([&] { LTISystem("s", {.A = wide, .B = one, .C = one}); }) ==
        "block 's': A is 1 x 2; expected 1 x 1, as A, B and C say");
  CHECK(contains(model_error([&] { LTISystem("s", {.A = one, .B = one, .C = wide}); }),
                 "C is 1 x 2; expected 1 x 1"));
  CHECK(contains(model_error([&] { LTISystem("s", {.A = one, .B = one, .C = one, .D = wide}); }),
                 "D is 1 x 2"));
  CHECK(contains(model_error([&] {
                   LTISystem("s", {.A = one, .B = one, .C = one},
                             {.initial_state = Eigen::Vector2d(1.0, 2.0)});
                 }),
                 "initial_state has 2 values; expected 1"));
}

/// Behind the filter, the derivative of t is 1 - e^(-N t), that of a step N e^(-N t).
TEST_CASE("Derivative is the derivative behind a filter", "[library][linear]") {
  const auto ramp = fed_by<Ramp>(Ramp::Options{.slope = 1.0, .start_time = 0.0});
  check_near(BlockRun<Derivative>(ramp, Derivative::Options{.filter_coefficient = 5.0}).at(times),
             [](double t) { return 1.0 - std::exp(-5.0 * t); });
  check_near(
      BlockRun<Derivative>(unit_step, Derivative::Options{.filter_coefficient = 5.0}).at(times),
      [](double t) { return 5.0 * std::exp(-5.0 * t); });
  check_near(BlockRun<Derivative>(unit_step, Derivative::Options{.initial_state = 1.0}).at(times),
             [](double) { return 0.0; });
}

TEST_CASE("a derivative without a filter is refused", "[library][linear]") {
  CHECK(contains(model_error([] { Derivative("d", {.filter_coefficient = 0.0}); }),
                 "filter_coefficient = 0 1/s; expected a finite number > 0"));
  CHECK(contains(model_error([] { Derivative("d", {.filter_coefficient = HUGE_VAL}); }),
                 "give a finite value"));
}
