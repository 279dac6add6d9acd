// Which shifts give a derivative, and where there is none.
#include "saltus/simulation/detail/difference_ladder.hpp"

#include <cmath>

#include "support/leaves.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using Function = std::function<double(double)>;

void look(DifferenceLadder& ladder, const Function& f, double shift) {
  const auto at = [&](double u) { return Eigen::VectorXd::Constant(1, f(u)).eval(); };
  const MovedValues moved{shift, at(shift), at(-shift), at(2.0 * shift), at(-2.0 * shift)};
  const Eigen::VectorXd centre = at(0.0);
  ladder.look(moved, [&] { return &centre; });
}

/// The derivative at 0 from these shifts, one after the other; NaN if it is open.
double derivative(const Function& f, const std::vector<double>& shifts) {
  DifferenceLadder ladder;
  ladder.begin(1, 1.0);
  for (const double shift : shifts) look(ladder, f, shift);
  double out = 0.0;
  const bool found = ladder.write(&out);
  CHECK(found == !std::isnan(out));
  return out;
}

const std::vector<double> all{1e-3, 1e-3 / 30.0, 1e-3 / 900.0, 1e-3 / 27e3, 1e-3 / 810e3};

}  // namespace

// f(u) - f(-u) over 2 u, and the same over 4 u, have the error u^4 / 30 f''''' together, and eps |f| / u
// by rounding: for u = 1e-3 and numbers of size 1 that is 4e-13, of which this allows four.
TEST_CASE("one pair of differences settles the derivative of a smooth function") {
  CHECK_THAT(derivative([](double u) { return std::sin(u); }, {1e-3}), WithinAbs(1.0, 1.6e-12));
  CHECK_THAT(derivative([](double u) { return std::exp(u); }, {1e-3}), WithinAbs(1.0, 1.6e-12));
  CHECK_THAT(derivative([](double u) { return 3.0 - 2.0 * u; }, {1e-3}), WithinAbs(-2.0, 1.6e-12));
  CHECK(derivative([](double) { return 7.0; }, {1e-3}) == 0.0);
}

TEST_CASE("a fast function is settled by a smaller shift, not by the first") {
  const Function fast = [](double u) { return std::sin(1e4 * u); };
  CHECK(std::isnan(derivative(fast, {1e-3})));
  // At u = 1e-3 / 900, c u = 0.011: (c u)^4 / 30 = 5e-10 of the derivative.
  CHECK_THAT(derivative(fast, all), WithinRel(1e4, 1e-9));
}

TEST_CASE("a kink or a jump has no derivative at any shift") {
  CHECK(std::isnan(derivative([](double u) { return std::abs(u); }, all)));
  CHECK(std::isnan(derivative([](double u) { return 2.0 * u + std::abs(u); }, all)));
  CHECK(std::isnan(derivative([](double u) { return u > 0.0 ? 1.0 : 0.0; }, all)));
  CHECK(std::isnan(derivative([](double u) { return std::max(u, 0.0); }, all)));
}

// v |v|: both differences fall with the shift, and towards 0.
TEST_CASE("the derivative 0 of v |v| is found, though its second derivative jumps") {
  CHECK_THAT(derivative([](double u) { return u * std::abs(u); }, all), WithinAbs(0.0, 1e-9));
}

TEST_CASE("a shift at which a function has no value settles nothing, and the next one does") {
  const Function root = [](double u) { return std::sqrt(1e-4 - u); };
  CHECK(std::isnan(derivative(root, {1e-3})));
  // At u = 1e-3 / 30, u = 0.33 of the distance to the end; at 1e-3 / 900 it is 0.011 of it.
  CHECK_THAT(derivative(root, all), WithinRel(-50.0, 1e-7));
}

// The argument is tiny (1e-9), so that the size of the value says nothing about the derivative.
TEST_CASE("rounding of a large value is called blur, and a larger shift replaces the derivative") {
  const Function large = [](double u) { return 1e9 + std::sin(u); };
  DifferenceLadder ladder;
  ladder.begin(1, 1e-9);
  look(ladder, large, 1e-6);
  CHECK_FALSE(ladder.open());
  CHECK(ladder.blurred());
  double first = 0.0, second = 0.0;
  ladder.write(&first);
  look(ladder, large, 1e-3);
  ladder.write(&second);
  // eps 1e9 / u is 0.2 at 1e-6 and 2e-4 at 1e-3; roundings of four values add.
  CHECK_THAT(first, WithinAbs(1.0, 0.5));
  CHECK_THAT(second, WithinAbs(1.0, 5e-4));
}

TEST_CASE("each number of a vector has a verdict of its own") {
  DifferenceLadder ladder;
  ladder.begin(2, 1.0);
  const auto at = [](double u) { return Eigen::Vector2d(std::sin(u), std::abs(u)).eval(); };
  const Eigen::VectorXd centre = at(0.0);
  for (const double u : all)
    ladder.look({u, at(u), at(-u), at(2.0 * u), at(-2.0 * u)}, [&] { return &centre; });
  double out[2];
  CHECK_FALSE(ladder.write(out));
  CHECK_THAT(out[0], WithinAbs(1.0, 1.6e-12));
  CHECK(std::isnan(out[1]));
}
