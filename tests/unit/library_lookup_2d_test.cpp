// LookupTable2d: its values, its knots, and what is refused.
#include <cmath>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

using Options = LookupTable2d::Options;

const Eigen::Vector3d points_x(0.0, 1.0, 3.0);
const Eigen::Vector2d points_y(0.0, 2.0);
const Eigen::MatrixXd table{{0.0, 2.0}, {10.0, 14.0}, {20.0, 24.0}};

Numbers looked_up(const Value& x, const Value& y, const Options& options = {}) {
  return Bench<LookupTable2d>({x, y}, points_x, points_y, table, options).output();
}

/// 0, 1, 0, 1, ...
Eigen::VectorXd zigzag(Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [](Index i) { return static_cast<double>(i % 2); });
}

/// The integral from 0 to 3 along (t, slope t), over a table of the sum of two zigzags.
double integral_of_zigzags(double slope, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::MatrixXd sums =
      zigzag(x.size()).replicate(1, y.size()) + zigzag(y.size()).transpose().replicate(x.size(), 1);
  const auto wire = [=](DiagramBuilder& builder, auto& block) {
    auto& clock = builder.add<Clock>("clock");
    auto& gain = builder.add<Gain>("gain", slope);
    builder.connect(clock.output(), gain.input());
    builder.connect(clock.output(), block.input(0));
    builder.connect(gain.output(), block.input(1));
  };
  return integral<LookupTable2d>(3.0, wire, x, y, sums);
}

}  // namespace

TEST_CASE("a table of two inputs is bilinear in each cell", "[library][lookup]") {
  CHECK(looked_up({0.0, 0.0, 1.0, 3.0}, {0.0, 2.0, 2.0, 2.0}) == Numbers{0.0, 2.0, 14.0, 24.0});
  CHECK(looked_up({0.5, 0.5, 2.0}, 1.0) == Numbers{6.5, 6.5, 17.0});
}

TEST_CASE("a table of two inputs clips at its border by default", "[library][lookup]") {
  CHECK(looked_up({-5.0, 9.0, -5.0, 9.0, 0.5}, {-5.0, -5.0, 9.0, 9.0, 9.0}) ==
        Numbers{0.0, 20.0, 2.0, 24.0, 8.0});
}

TEST_CASE("a table of two inputs may extrapolate, or refuse to", "[library][lookup]") {
  CHECK(looked_up({-1.0, 5.0, 0.0}, {0.0, 0.0, 3.0}, {"linear"}) == Numbers{-10.0, 30.0, 3.0});
  const Numbers y = looked_up({-0.1, 0.0, 3.0, 3.1, 1.0}, {1.0, 0.0, 2.0, 1.0, 2.1}, {"error"});
  CHECK(std::isnan(y[0]));
  CHECK(y[1] == 0.0);
  CHECK(y[2] == 24.0);
  CHECK(std::isnan(y[3]));
  CHECK(std::isnan(y[4]));
}

/// Each zigzag has the mean 1/2: 3 together. A step over a knot of either would see a kink.
TEST_CASE("the integral over the cells of a table is exact", "[library][lookup]") {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(7, 0.0, 3.0);
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(11, 0.0, 6.0);
  CHECK_THAT(integral_of_zigzags(2.0, x, y), WithinAbs(3.0, rounding));
  CHECK_THAT(integral_of_zigzags(-2.0, x, -y.reverse()), WithinAbs(3.0, rounding));
}

TEST_CASE("a table of two inputs has a guard for each, where it reaches a derivative",
          "[library][lookup]") {
  DiagramBuilder builder;
  auto& block = builder.add<LookupTable2d>("block", points_x, points_y, table);
  auto& sum = builder.add<Integrator>("sum");
  auto& clock = builder.add<Clock>("clock");
  for (int k = 0; k < 2; ++k) builder.connect(clock.output(), block.input(k));
  builder.connect(block.output(), sum.input());
  const Diagram diagram = builder.build();
  CHECK(compile(diagram)->guards.size() == 2);
  CHECK(Bench<LookupTable2d>({1.0, 1.0}, points_x, points_y, table).plan().guards.empty());
}

TEST_CASE("tables of two inputs that do not fit are refused", "[library][lookup]") {
  const auto made = [](const Eigen::VectorXd& x, const Eigen::MatrixXd& values,
                       const Options& options = {}) {
    return model_error([&] { LookupTable2d("t", x, points_y, values, options); });
  };
  CHECK(contains(made(points_x, Eigen::MatrixXd::Zero(2, 2)),
                 "output_table is 2 x 2; expected 3 x 2, as input_x and input_y say"));
  CHECK(contains(made(Eigen::Vector3d(0.0, 0.0, 1.0), table), "expected points that increase"));
  CHECK(contains(made(points_x, table, {"wrap"}), "unknown extrapolation 'wrap'"));
}
