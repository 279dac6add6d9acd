// LookupTable1d: its values, its knots, and what is refused.
#include <cmath>

#include "library_runs.hpp"
#include "saltus/library/lookup_table_1d.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

using Options = LookupTable1d::Options;

const Eigen::Vector4d points(0.0, 1.0, 2.0, 4.0), values(0.0, 2.0, 1.0, 5.0);

Numbers looked_up(const std::vector<double>& u, const Options& options = {}) {
  const Eigen::VectorXd inputs =
      Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Index>(u.size()));
  return Bench<LookupTable1d>({inputs}, points, values, options).output();
}

Diagram behind_a_ramp(double slope, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  DiagramBuilder builder;
  auto& ramp = builder.add<Ramp>("ramp", Ramp::Options{.slope = slope, .start_time = 0.0});
  auto& table = builder.add<LookupTable1d>("block", x, y);
  auto& sum = builder.add<Integrator>("sum");
  builder.connect(ramp.output(), table.input());
  builder.connect(table.output(), sum.input());
  return builder.build();
}

}  // namespace

TEST_CASE("a table interpolates and clips by default", "[library][lookup]") {
  CHECK(looked_up({-3.0, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0}) ==
        Numbers{0.0, 0.0, 1.0, 2.0, 1.5, 1.0, 3.0, 5.0, 5.0});
}

TEST_CASE("a table extrapolates its outer lines", "[library][lookup]") {
  CHECK(looked_up({-3.0, 0.5, 1.5, 6.0}, {.extrapolation = "linear"}) ==
        Numbers{-6.0, 1.0, 1.5, 9.0});
}

TEST_CASE("a table takes the nearest value, or the one before", "[library][lookup]") {
  CHECK(looked_up({-3.0, 0.4, 0.6, 1.4, 1.6, 2.9, 3.1, 9.0}, {.interpolation = "nearest"}) ==
        Numbers{0.0, 0.0, 2.0, 2.0, 1.0, 1.0, 5.0, 5.0});
  CHECK(looked_up({-3.0, 0.6, 1.4, 1.6, 3.9, 4.5}, {.interpolation = "flat"}) ==
        Numbers{0.0, 0.0, 2.0, 2.0, 1.0, 5.0});
}

TEST_CASE("outside of a table that is an error the value is no number", "[library][lookup]") {
  const Numbers y = looked_up({-0.1, 0.0, 4.0, 4.1}, {.extrapolation = "error"});
  CHECK(std::isnan(y[0]));
  CHECK(y[1] == 0.0);
  CHECK(y[2] == 5.0);
  CHECK(std::isnan(y[3]));
}

/// The trapezoids of the table: 1 + 1.5 + 6, and beyond it 5 a second.
TEST_CASE("the integral over the knots of a table is exact, up and down", "[library][lookup]") {
  const auto integral_of = [](double slope, const Eigen::VectorXd& x) {
    const Diagram diagram = behind_a_ramp(slope, x, values);
    return at_times(diagram, diagram["sum"].output(), {6.0})[0];
  };
  CHECK_THAT(integral_of(1.0, points), WithinAbs(1.0 + 1.5 + 6.0 + 10.0, rounding));
  const Eigen::Vector4d mirrored(-4.0, -2.0, -1.0, 0.0);
  const Diagram down = behind_a_ramp(-1.0, mirrored, values.reverse());
  CHECK_THAT(at_times(down, down["sum"].output(), {6.0})[0], WithinAbs(18.5, rounding));
}

/// 200 knots of a zigzag: each is located, by one guard, though a step could span many.
TEST_CASE("a table of many knots has one guard and loses none", "[library][lookup]") {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(201, 0.0, 200.0);
  Eigen::VectorXd y(201);
  for (Index i = 0; i < y.size(); ++i) y[i] = i % 2 == 0 ? 0.0 : 1.0;
  const Diagram diagram = behind_a_ramp(1.0, x, y);
  CHECK(compile(diagram)->guards.size() == 1);
  const auto results = simulate(diagram, diagram.create_context(), {0.0, 200.0}, precise());
  // A few eps of t = 200 for each of the knots: 200 * 200 * 2e-16.
  CHECK_THAT(results.context.continuous_state()[0], WithinAbs(100.0, 1e-11));
  CHECK(results.events.times("block.even_piece").size() >= 199);
}

TEST_CASE("a table whose value reaches no derivative has no guard", "[library][lookup]") {
  CHECK(Bench<LookupTable1d>({1.0}, points, values).plan().guards.empty());
}

TEST_CASE("tables that do not fit are refused", "[library][lookup]") {
  const auto made = [](const Eigen::VectorXd& x, const Eigen::VectorXd& y, const Options& options) {
    return model_error([&] { LookupTable1d("t", x, y, options); });
  };
  CHECK(contains(made(points, Eigen::Vector2d(1.0, 2.0), {}),
                 "input_array has 4 values, output_array has 2"));
  CHECK(contains(made(Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(1.0, 2.0), {}),
                 "point 1 is 1 after 1; expected points that increase"));
  CHECK(contains(made(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1), {}), "2 points or more"));
  CHECK(contains(made(points, values, {.interpolation = "cubic"}), "unknown interpolation"));
  CHECK(contains(made(points, values, {.extrapolation = "wrap"}), "unknown extrapolation"));
  CHECK(contains(made(points, values, {.interpolation = "flat", .extrapolation = "linear"}),
                 "needs interpolation 'linear'"));
}
