// Linear blocks at ticks: closed forms of their difference equations.
#include <cmath>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

const std::vector<double> six{0.0, 1.0, 2.0, 3.0, 4.0, 5.0};

/// u[0] = 1, afterwards 0.
const auto impulse =
    fed_by<Step>(Step::Options{.start_value = 1.0, .end_value = 0.0, .step_time = 0.5});
const auto ramp = fed_by<Clock>();

void check_close(const Numbers& found, const Numbers& exact) {
  REQUIRE(found.size() == exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    CHECK_THAT(found[i], WithinAbs(exact[i], rounding));
}

Numbers integrated(std::string_view method) {
  return BlockRun<IntegratorDiscrete>(ramp, 1.0, IntegratorDiscrete::Options{.method = method})
      .at(six);
}

}  // namespace

/// Sums of u[k] = k: k (k - 1) / 2, k (k + 1) / 2 and k^2 / 2.
TEST_CASE("an IntegratorDiscrete sums by three rules", "[library][sampled]") {
  CHECK(integrated("forward") == Numbers{0.0, 0.0, 1.0, 3.0, 6.0, 10.0});
  CHECK(integrated("backward") == Numbers{0.0, 1.0, 3.0, 6.0, 10.0, 15.0});
  CHECK(integrated("trapezoidal") == Numbers{0.0, 0.5, 2.0, 4.5, 8.0, 12.5});
}

/// The trigger is true at the ticks 2 and 3, and resets once, to 10.
TEST_CASE("an IntegratorDiscrete is reset at the tick that sees the edge", "[library][sampled]") {
  const auto wire = [](DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Constant>("one", 1.0).output(), block.input(0));
    builder.connect(
        builder
            .add<Pulse>("trigger",
                        Pulse::Options{.period = 9.0, .pulse_width = 2.0 / 9.0, .phase_delay = 1.5})
            .output(),
        block.input(1));
    builder.connect(builder.add<Constant>("to", 10.0).output(), block.input(2));
  };
  const auto with = [&](std::string_view method) {
    return BlockRun<IntegratorDiscrete>(
               wire, 1.0,
               IntegratorDiscrete::Options{
                   .method = method, .enable_reset = true, .enable_external_reset = true})
        .at(six);
  };
  CHECK(with("forward") == Numbers{0.0, 1.0, 10.0, 11.0, 12.0, 13.0});
  CHECK(with("backward") == Numbers{0.0, 1.0, 10.0, 11.0, 12.0, 13.0});
  CHECK(with("trapezoidal") == Numbers{0.0, 1.0, 10.0, 11.0, 12.0, 13.0});
}

/// Up for 3 s to the limit 2, then down: without winding up it leaves the limit at once.
TEST_CASE("an IntegratorDiscrete does not wind up", "[library][sampled]") {
  const auto turn =
      fed_by<Step>(Step::Options{.start_value = 1.0, .end_value = -1.0, .step_time = 3.0});
  for (const std::string_view method : {"forward", "backward"}) {
    const IntegratorDiscrete::Options options{
        .method = method, .enable_limits = true, .upper_limit = 2.0};
    const Numbers y = BlockRun<IntegratorDiscrete>(turn, 1.0, options).at({2.0, 3.0, 4.0, 5.0});
    CHECK(y == (method == "forward" ? Numbers{2.0, 2.0, 1.0, 0.0} : Numbers{2.0, 1.0, 0.0, -1.0}));
  }
}

/// A start, a context and a reset may put it beyond; a hold keeps it where it is.
TEST_CASE("an IntegratorDiscrete is within its limits from the first tick on",
          "[library][sampled]") {
  const auto method = GENERATE("forward", "backward", "trapezoidal");
  const double beyond = GENERATE(5.0, -5.0);
  INFO("method " << method);
  const IntegratorDiscrete::Options options{.initial_state = beyond,
                                            .method = method,
                                            .enable_reset = true,
                                            .enable_limits = true,
                                            .lower_limit = -2.0,
                                            .upper_limit = 2.0,
                                            .enable_hold = true};
  const auto wire = [](DiagramBuilder& builder, IntegratorDiscrete& block) {
    builder.connect(builder.add<Constant>("zero", 0.0).output(), block.input("in"));
    builder.connect(
        builder.add<Pulse>("pulse", PulseOptions{.period = 2.0, .phase_delay = 2.0}).output(),
        block.input("reset_trigger"));
    builder.connect(
        builder
            .add<Step>("hold", StepOptions{.start_value = 1.0, .end_value = 0.0, .step_time = 1.5})
            .output(),
        block.input("hold_trigger"));
  };
  const Numbers y =
      BlockRun<IntegratorDiscrete>(wire, 1.0, options).at({0.0, 0.5, 1.5, 2.5, 3.5, 4.5});
  for (const double each : y) CHECK(each == (beyond > 0.0 ? 2.0 : -2.0));
}

TEST_CASE("an IntegratorDiscrete on hold does not change", "[library][sampled]") {
  const auto wire = [](DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Constant>("one", 1.0).output(), block.input(0));
    builder.connect(builder.add<Step>("hold", Step::Options{.step_time = 2.5}).output(),
                    block.input(1));
  };
  const BlockRun<IntegratorDiscrete> scene(wire, 1.0,
                                           IntegratorDiscrete::Options{.enable_hold = true});
  CHECK(scene.at(six) == Numbers{0.0, 1.0, 2.0, 3.0, 3.0, 3.0});
}

/// 1 / (z^2 - z - 1): Fibonacci's numbers, two ticks late; with z^2 above, from the first tick on.
TEST_CASE("a TransferFunctionDiscrete is its power series in 1 / z", "[library][sampled]") {
  const Eigen::Vector3d den(1.0, -1.0, -1.0);
  const auto of = [&](const Eigen::VectorXd& num) {
    return BlockRun<TransferFunctionDiscrete>(impulse, 1.0, num, den).at(six);
  };
  CHECK(of(Eigen::VectorXd::Ones(1)) == Numbers{0.0, 0.0, 1.0, 1.0, 2.0, 3.0});
  CHECK(of(Eigen::Vector2d(1.0, 0.0)) == Numbers{0.0, 1.0, 1.0, 2.0, 3.0, 5.0});
  CHECK(of(Eigen::Vector3d(1.0, 0.0, 0.0)) == Numbers{1.0, 1.0, 2.0, 3.0, 5.0, 8.0});
  CHECK(of(Eigen::Vector3d(2.0, 0.0, 1.0)) == Numbers{2.0, 2.0, 5.0, 7.0, 12.0, 19.0});
}

/// The same transfer function, (2 z^2 + 1) / (z^2 - z - 1) = 2 + (2 z + 3) / (z^2 - z - 1).
TEST_CASE("an LTISystemDiscrete is its transfer function", "[library][sampled]") {
  LTISystemMatrices m{.A = Eigen::Matrix2d{{1.0, 1.0}, {1.0, 0.0}},
                      .B = Eigen::Vector2d(1.0, 0.0),
                      .C = Eigen::RowVector2d(2.0, 3.0),
                      .D = Eigen::MatrixXd::Constant(1, 1, 2.0)};
  CHECK(BlockRun<LTISystemDiscrete>(impulse, 1.0, m).at(six) ==
        Numbers{2.0, 2.0, 5.0, 7.0, 12.0, 19.0});
  m.D.reset();
  const LTISystemDiscrete::Options start{Eigen::Vector2d(1.0, 1.0)};
  CHECK(BlockRun<LTISystemDiscrete>(fed_by<Constant>(0.0), 1.0, m, start).at(six) ==
        Numbers{5.0, 7.0, 12.0, 19.0, 31.0, 50.0});
  const Bench<LTISystemDiscrete> bench({1.0}, 1.0, m);
  CHECK(bench.node().needs.empty());
}

TEST_CASE("a FilterDiscrete is the sum of its last inputs", "[library][sampled]") {
  const Eigen::Vector3d b(1.0, 10.0, 100.0);
  CHECK(BlockRun<FilterDiscrete>(impulse, 1.0, b).at(six) ==
        Numbers{1.0, 10.0, 100.0, 0.0, 0.0, 0.0});
  CHECK(BlockRun<FilterDiscrete>(ramp, 1.0, b, FilterDiscrete::Options{2.0}).at({0.0, 1.0, 2.0}) ==
        Numbers{220.0, 201.0, 12.0});
}

/// Of u = 3 t: 3 from the second tick on. The filter of N = 2 with dt = 1: y[k] = 3 (1 - 3^-k).
TEST_CASE("a DerivativeDiscrete is a difference, or its filter", "[library][sampled]") {
  const auto slope = fed_by<Ramp>(Ramp::Options{.slope = 3.0, .start_time = 0.0});
  CHECK(BlockRun<DerivativeDiscrete>(slope, 0.5).at({0.0, 0.5, 1.0, 1.7}) ==
        Numbers{0.0, 3.0, 3.0, 3.0});
  Numbers exact;
  for (const double k : six) exact.push_back(3.0 * (1.0 - std::pow(3.0, -k)));
  check_close(BlockRun<DerivativeDiscrete>(slope, 1.0, DerivativeDiscrete::Options{2.0}).at(six),
              exact);
}

TEST_CASE("the first tick of a derivative makes no kick", "[library][sampled]") {
  CHECK(BlockRun<DerivativeDiscrete>(fed_by<Constant>(5.0), 1.0).at({0.0, 1.0}) ==
        Numbers{0.0, 0.0});
  const PIDDiscrete::Options options{.kp = 0.0, .kd = 1.0};
  CHECK(BlockRun<PIDDiscrete>(fed_by<Constant>(5.0), 1.0, options).at({0.0, 1.0}) ==
        Numbers{0.0, 0.0});
}

/// Of u = t with n = 2 and dt = 1: d[k] = 1 - 3^-k, i[k] = ki k (k - 1) / 2.
TEST_CASE("a PIDDiscrete adds its three parts", "[library][sampled]") {
  const PIDDiscrete::Options options{
      .kp = 2.0, .ki = 4.0, .kd = 0.5, .n = 2.0, .initial_state = 7.0};
  Numbers exact;
  for (const double k : six)
    exact.push_back(2.0 * k + 2.0 * k * (k - 1.0) + 0.5 * (1.0 - std::pow(3.0, -k)) + 7.0);
  check_close(BlockRun<PIDDiscrete>(ramp, 1.0, options).at(six), exact);
}

/// A forward rule would multiply the state of the filter by 1 - n dt = -1e6 at each tick.
TEST_CASE("the derivative of a PIDDiscrete is stable for a fast filter", "[library][sampled]") {
  const PIDDiscrete::Options options{.kp = 0.0, .kd = 1.0, .n = 1e6};
  const Numbers y = BlockRun<PIDDiscrete>(ramp, 1.0, options).at({1.0, 5.0, 50.0});
  for (const double each : y) CHECK_THAT(each, WithinAbs(1.0, 1.1e-6));  // n / (1 + n dt)
}

/// The error is 1 up to 4 s, then -1: i stays at 1.5, where v is above the limit, and falls as soon
/// as the error turns. Wound up it would be 4.
TEST_CASE("the integral of a PIDDiscrete does not wind up", "[library][sampled]") {
  const auto turn =
      fed_by<Step>(Step::Options{.start_value = 1.0, .end_value = -1.0, .step_time = 4.0});
  const PIDDiscrete::Options options{.ki = 1.0, .lower_limit = -2.0, .upper_limit = 2.0};
  const BlockRun<PIDDiscrete> scene(turn, 0.5, options);
  CHECK(scene.at({0.5, 1.5, 3.5, 4.0, 5.0, 6.0}) == Numbers{1.5, 2.0, 2.0, 0.5, -0.5, -1.5});
}

TEST_CASE("discrete systems that are none are refused", "[library][sampled]") {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  CHECK(contains(
      model_error([&] { TransferFunctionDiscrete("g", 1.0, Eigen::Vector2d(1.0, 0.0), one); }),
      "the degree 1 in z, the denominator 0; expected a proper transfer function: multiply the "
      "denominator by a power of z"));
  CHECK(contains(model_error([&] { FilterDiscrete("f", 1.0, Eigen::VectorXd()); }),
                 "expected 1 b_coefficients or more"));
  CHECK(contains(model_error([] { PIDDiscrete("c", 1.0, {.n = 0.0}); }), "n = 0 1/s"));
  CHECK(
      contains(model_error([] { PIDDiscrete("c", 1.0, {.lower_limit = 2.0, .upper_limit = 1.0}); }),
               "lower_limit 2 is not below upper_limit 1"));
  CHECK(contains(model_error([] { DerivativeDiscrete("d", 1.0, {.filter_coefficient = 0.0}); }),
                 "filter_coefficient = 0"));
  CHECK(contains(model_error([] { IntegratorDiscrete("x", 1.0, {.method = "simpson"}); }),
                 "unknown method 'simpson'"));
  CHECK(contains(model_error([] { IntegratorDiscrete("x", 1.0, {.enable_external_reset = true}); }),
                 "enable_external_reset without enable_reset"));
  CHECK(contains(model_error([] { IntegratorDiscrete("x", -1.0); }), "dt = -1 s"));
}
