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

TEST_CASE("a new look takes the place of the outer one away from the lowest", "[dip]") {
  struct Row {
    double at, value, u[3];
  };
  const Row rows[] = {{0.5, 0.2, {0.0, 0.5, 1.0}},   // lower, in front: the new middle
                      {0.5, 3.0, {0.5, 1.0, 2.0}},   // higher, in front: a new left
                      {1.5, 0.2, {1.0, 1.5, 2.0}},   // lower, behind
                      {1.5, 3.0, {0.0, 1.0, 1.5}}};  // higher, behind
  for (const Row& row : rows) {
    INFO("a look of " << row.value << " at " << row.at);
    Dip dip{{0.0, 1.0, 2.0}, {4.0, 1.0, 4.0}};
    dip.replace(row.at, row.value);
    for (int i = 0; i < 3; ++i) {
      CHECK(dip.u[i] == row.u[i]);
      CHECK(dip.g[i] == (dip.u[i] == row.at ? row.value : dip.u[i] == 1.0 ? 1.0 : 4.0));
    }
  }
}

TEST_CASE("looking where the parabola says finds the dip of another curve in a few looks",
          "[dip]") {
  const auto curve = [](double u) { return std::cosh(3.0 * (u - 0.6)) - 1.01; };
  Dip dip = looks(curve, 0.0, 0.5, 1.5);
  dip.g[1] = curve(dip.u[1] = 0.4);
  int count = 0;
  for (double at = dip.vertex(0.1); at != Dip::nowhere && count < 20; at = dip.vertex(0.1)) {
    ++count;
    const double value = curve(at);
    if (value < 0.0) break;
    dip.replace(at, value);
  }
  CHECK(count <= 4);
}
