// LookupTableNd: its values, its knots, and what is refused.
#include <cmath>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

using Options = LookupTableNd::Options;
using Axes = std::vector<Eigen::VectorXd>;

const Axes axes{Eigen::Vector2d(0.0, 1.0), Eigen::Vector3d(0.0, 1.0, 3.0),
                Eigen::Vector2d(0.0, 2.0)};

/// x + 10 y + 100 z + x y z at the points, row by row: the table is exact in each cell.
double law(double x, double y, double z) { return x + 10.0 * y + 100.0 * z + x * y * z; }
Eigen::VectorXd table() {
  Eigen::VectorXd values(12);
  Index k = 0;
  for (const double x : axes[0])
    for (const double y : axes[1])
      for (const double z : axes[2]) values[k++] = law(x, y, z);
  return values;
}

double looked_up(double x, double y, double z, const Options& options = {}) {
  return Bench<LookupTableNd>({x, y, z}, axes, table(), options).output()[0];
}

}  // namespace

TEST_CASE("a table of three inputs is linear along each in each cell", "[library][lookup]") {
  for (const auto& [x, y, z] : {std::tuple{0.25, 0.5, 1.0}, {0.0, 3.0, 2.0}, {1.0, 2.0, 0.5}})
    CHECK_THAT(looked_up(x, y, z), WithinAbs(law(x, y, z), rounding * 100.0));
}

TEST_CASE("a table of three inputs clips, continues, or refuses", "[library][lookup]") {
  CHECK_THAT(looked_up(-1.0, 9.0, 1.0), WithinAbs(law(0.0, 3.0, 1.0), rounding * 100.0));
  CHECK_THAT(looked_up(2.0, 4.0, 3.0, {"linear"}), WithinAbs(law(2.0, 4.0, 3.0), rounding * 100.0));
  CHECK(std::isnan(looked_up(0.5, 3.1, 1.0, {"error"})));
  CHECK_THAT(looked_up(1.0, 3.0, 2.0, {"error"}), WithinAbs(law(1.0, 3.0, 2.0), rounding * 100.0));
}

/// A table of one and of two inputs is that of LookupTable1d and LookupTable2d, to the bit.
TEST_CASE("a table of two inputs agrees with LookupTable2d", "[library][lookup]") {
  const Eigen::VectorXd x = Eigen::Vector3d(0.0, 1.0, 3.0), y = Eigen::Vector2d(0.0, 2.0);
  const Eigen::MatrixXd matrix{{0.0, 2.0}, {10.0, 14.0}, {20.0, 24.0}};
  Eigen::VectorXd rows(6);
  rows << 0.0, 2.0, 10.0, 14.0, 20.0, 24.0;
  const Value u{-1.0, 0.3, 1.0, 2.2, 5.0}, v{0.1, 1.7, 2.0, -1.0, 0.5};
  const Numbers nd = Bench<LookupTableNd>({u, v}, Axes{x, y}, rows).output();
  const Numbers expected = Bench<LookupTable2d>({u, v}, x, y, matrix).output();
  for (std::size_t i = 0; i < nd.size(); ++i)
    CHECK_THAT(nd[i], WithinAbs(expected[i], 24.0 * rounding));
}

/// Along (t, t, t) a zigzag of each axis has the mean 1/2; a step over a knot would see a kink.
/// One guard an axis, however many points it has.
TEST_CASE("the knots of a table of three inputs are located by one guard an axis",
          "[library][lookup]") {
  const Eigen::VectorXd even = Eigen::VectorXd::LinSpaced(7, 0.0, 3.0);
  const Eigen::VectorXd odd = Eigen::VectorXd::LinSpaced(4, 0.0, 3.0);
  Eigen::VectorXd sums(7 * 4 * 2);
  Index n = 0;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 2; ++k) sums[n++] = i % 2 + j % 2 + k % 2;
  const auto wire = [](DiagramBuilder& builder, auto& block) {
    auto& clock = builder.add<Clock>("clock");
    for (int k = 0; k < 3; ++k) builder.connect(clock.output(), block.input(k));
  };
  const double found =
      integral<LookupTableNd>(3.0, wire, Axes{even, odd, Eigen::Vector2d(0.0, 3.0)}, sums);
  CHECK_THAT(found, WithinAbs(4.5, rounding));
  const LookupTableNd block("block", Axes{even, odd, Eigen::Vector2d(0.0, 3.0)}, sums);
  CHECK(block.input_names().size() == 3);
}

TEST_CASE("a table of n inputs refuses what does not fit", "[library][errors]") {
  const auto refused = [](const Axes& found, Index n) {
    return model_error([&] { LookupTableNd("t", found, Eigen::VectorXd::Zero(n)); });
  };
  CHECK(contains(refused({}, 1), "expected 1 axis or more"));
  CHECK(contains(refused(axes, 11), "output_table has 11 values; expected 12"));
  CHECK(contains(refused({Eigen::Vector2d(1.0, 0.0)}, 2), "increase"));
}
