// Dip: where a guard that was positive at three looks may have been below zero in between.
#include "saltus/solver/detail/dip.hpp"

#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinAbs;

namespace {

/// Three looks at f, at u = a, b, c.
template <class F>
Dip looks(F f, double a, double b, double c) {
  return {{a, b, c}, {f(a), f(b), f(c)}};
}

/// (u - 0.7)^2 - depth: below zero around 0.7.
auto valley(double depth) {
  return [depth](double u) { return (u - 0.7) * (u - 0.7) - depth; };
}

}  // namespace

TEST_CASE("the vertex of a parabola is found, whatever the looks", "[dip]") {
  CHECK_THAT(looks(valley(0.01), 0.0, 0.5, 1.0).vertex(0.0), WithinAbs(0.7, 1e-13));
  CHECK_THAT(looks(valley(1e-9), 0.0, 0.1, 1.0).vertex(0.0), WithinAbs(0.7, 1e-13));
  CHECK_THAT(looks(valley(0.001), 0.5, 0.6, 2.0).vertex(0.0), WithinAbs(0.7, 1e-13));
}

TEST_CASE("a vertex that stays above the highest value asked for is none", "[dip]") {
  const Dip shallow = looks(valley(-0.01), 0.0, 0.5, 1.0);  // least value 0.01
  CHECK(shallow.vertex(0.0) == Dip::nowhere);
  CHECK_THAT(shallow.vertex(0.02), WithinAbs(0.7, 1e-13));
}

TEST_CASE("looks below zero, a hill, a line, or the vertex itself say nothing new", "[dip]") {
  CHECK(Dip{{0.0, 1.0, 2.0}, {1.0, -1.0, 1.0}}.vertex(0.0) == Dip::nowhere);
  CHECK(Dip{{0.0, 1.0, 2.0}, {1.0, 0.0, 1.0}}.vertex(0.0) == Dip::nowhere);
  CHECK(Dip{{0.0, 1.0, 2.0}, {1.0, 3.0, 1.0}}.vertex(5.0) == Dip::nowhere);
  CHECK(Dip{{0.0, 1.0, 2.0}, {3.0, 2.0, 1.0}}.vertex(5.0) == Dip::nowhere);
  CHECK(Dip{{0.0, 1.0, 2.0}, {1.5, 0.5, 1.5}}.vertex(1.0) == Dip::nowhere);  // at u[1]
}

TEST_CASE("looks whose differences overflow name no place between them", "[dip]") {
  const double u = Dip{{0.0, 1.0, 2.0}, {1e308, 1e-308, 1e308}}.vertex(0.0);
  CHECK(!(u > 0.0 && u < 2.0));
}
