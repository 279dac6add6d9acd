// Chirp, Sawtooth, DataSource: their values and their exact events.
#include <cmath>
#include <numbers>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

const auto alone = [](DiagramBuilder&, auto&) {};

}  // namespace

/// The phase is t^2 / 2 + t up to 2 s, where the frequency is 3, and grows by 3 a second
/// afterwards.
TEST_CASE("a Chirp sweeps its frequency, and then keeps it", "[library][signals]") {
  const BlockRun<Chirp> scene(alone,
                              Chirp::Options{.f0 = 1.0, .f1 = 3.0, .stop_time = 2.0, .phi = 0.5});
  const std::vector<double> times{0.0, 1.0, 2.0, 3.0};
  const Numbers y = scene.at(times), phase{0.0, 1.5, 4.0, 7.0};
  // A few roundings of a phase below 8: 8 * 2e-16 * 4.
  for (std::size_t i = 0; i < y.size(); ++i)
    CHECK_THAT(y[i], WithinAbs(std::cos(0.5 + phase[i]), 1e-14));
  CHECK(scene.run(3.0).events.times("block.stop") == std::vector{2.0});
}

TEST_CASE("a Sawtooth rises from each jump to the next", "[library][signals]") {
  const Sawtooth::Options options{.amplitude = {2.0, -4.0}, .frequency = 0.5, .phase_delay = 1.0};
  const BlockRun<Sawtooth> scene(alone, options);
  const std::vector<double> times{0.0, 0.5, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0};
  CHECK(scene.at(times) == Numbers{0.0, 0.0, 0.0, 1.0, 1.5, 0.0, 1.0, 0.0});
  CHECK(at_times(scene.diagram, scene.block->output(), times, 1)[4] == -3.0);
}

/// 300 teeth of the area 1/6 each; a step that saw the fall would be off by a step's length.
TEST_CASE("no solver step spans the fall of a Sawtooth", "[library][signals]") {
  const double area = integral<Sawtooth>(100.0, alone, Sawtooth::Options{.frequency = 3.0});
  CHECK_THAT(area, WithinAbs(50.0, 300.0 * rounding));
}

/// 1000 periods of 1/3 s: y = 0 at the jump, and at the sample of a block that ticks with it.
TEST_CASE("the jumps of a Sawtooth are counted exactly", "[library][signals]") {
  DiagramBuilder builder;
  auto& tooth = builder.add<Sawtooth>("tooth", Sawtooth::Options{.frequency = 3.0});
  auto& sampled = builder.add<RateTransition>("sampled", 1.0 / 3.0, RateTransition::Options{7.0});
  builder.connect(tooth.output(), sampled.input());
  const Diagram diagram = builder.build();
  std::vector<double> times;
  for (int k = 0; k < 1000; ++k) times.push_back(k / 3.0);
  for (const OutputPort port : {tooth.output(), sampled.output()}) {
    // Some roundings of t, in periods: 3 * 333 * 2e-16 * 8.
    for (const double y : at_times(diagram, port, times)) CHECK_THAT(y, WithinAbs(0.0, 2e-12));
  }
}

TEST_CASE("a DataSource is linear between its times", "[library][signals]") {
  const Eigen::Vector4d times(1.0, 2.0, 4.0, 5.0), values(0.0, 3.0, 1.0, 1.0);
  const std::vector<double> at{0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 4.5, 5.0, 9.0};
  const auto of = [&](std::string_view beyond) {
    return BlockRun<DataSource>(alone, times, values, DataSource::Options{.extrapolation = beyond})
        .at(at);
  };
  CHECK(of("hold") == Numbers{0.0, 0.0, 1.5, 3.0, 2.0, 1.0, 1.0, 1.0, 1.0});
  CHECK(of("zero") == Numbers{0.0, 0.0, 1.5, 3.0, 2.0, 1.0, 1.0, 0.0, 0.0});
  // Trapezoids: 1.5 + 4 + 1, and then 1 a second.
  CHECK_THAT(integral<DataSource>(9.0, alone, times, values), WithinAbs(10.5, rounding));
}

/// A zigzag of 1000 pieces over 10 s: any step that spanned a knot would be off by its length.
TEST_CASE("no solver step spans a time of a table", "[library][signals]") {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  Eigen::VectorXd values(1001);
  for (Index i = 0; i < 1001; ++i) values[i] = static_cast<double>(i % 2);
  CHECK_THAT(integral<DataSource>(10.0, alone, times, values), WithinAbs(5.0, 1000.0 * rounding));
}

TEST_CASE("a DataSource may hold, and have columns", "[library][signals]") {
  const Eigen::Vector3d times(0.0, 1.0, 3.0);
  const Eigen::Matrix<double, 3, 2> values{{1.0, 10.0}, {2.0, 20.0}, {3.0, 30.0}};
  const BlockRun<DataSource> scene(alone, times, values,
                                   DataSource::Options{.interpolation = "zero_order_hold"});
  const std::vector<double> at{0.0, 0.9, 1.0, 2.9, 3.0, 8.0};
  CHECK(scene.at(at) == Numbers{1.0, 1.0, 2.0, 2.0, 3.0, 3.0});
  CHECK(at_times(scene.diagram, scene.block->output(), at, 1) ==
        Numbers{10.0, 10.0, 20.0, 20.0, 30.0, 30.0});
  const Bench<DataSource> bench({}, times, values,
                                DataSource::Options{.interpolation = "zero_order_hold"});
  CHECK(bench.node().rate == Rate::held);
}

TEST_CASE("tables and waves that are none are refused", "[library][signals]") {
  const Eigen::Vector2d two(0.0, 1.0);
  const auto made = [](const Eigen::VectorXd& t, const Eigen::MatrixXd& y,
                       const DataSource::Options& options = {}) {
    return model_error([&] { DataSource("d", t, y, options); });
  };
  CHECK(contains(made(Eigen::Vector2d(1.0, 1.0), two), "time 1 is 1 s after 1 s"));
  CHECK(contains(made(Eigen::Vector2d(0.0, HUGE_VAL), two), "expected finite times"));
  CHECK(contains(made(two, Eigen::Vector3d::Zero()), "times has 2 values, values has 3 rows of 1"));
  CHECK(contains(made(Eigen::VectorXd(), Eigen::VectorXd()), "expected 1 times or more"));
  CHECK(contains(made(two, two, {.interpolation = "cubic"}), "unknown interpolation 'cubic'"));
  CHECK(contains(made(two, two, {.extrapolation = "wrap"}), "unknown extrapolation 'wrap'"));
  CHECK(contains(model_error([] { Sawtooth("s", {.frequency = 0.0}); }), "frequency = 0 1/s"));
  CHECK(contains(model_error([] { Chirp("c", {.stop_time = -1.0}); }), "stop_time = -1 s"));
}
