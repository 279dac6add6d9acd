// The decisions of Radau's stepper: cuts at events, steps along a jump, and what Newton's iteration
// may leave.
#include "saltus/solver/detail/radau/allowed_estimate.hpp"
#include "saltus/solver/detail/radau/convergence.hpp"
#include "saltus/solver/detail/radau/creep.hpp"
#include "saltus/solver/detail/radau/cut.hpp"
#include "saltus/solver/detail/radau/residual.hpp"
#include "saltus/solver/detail/radau/step_control.hpp"

#include <Eigen/Core>

#include "support/catch.hpp"

using namespace saltus;
using namespace saltus::radau;

namespace {

constexpr double eps = thresholds::eps;

/// How far beyond its root a step of length 1 is cut, in parts of the root; -1 if it is not cut.
double beyond(double root, double off) { return cut_length(root, 1.0, off) / root - 1.0; }

}  // namespace

TEST_CASE("a step is cut beyond its root by more than the root may be off on either side",
          "[radau]") {
  const double root = GENERATE(0.01, 0.5, 0.9);
  for (const double off : {1e-10, 1e-7, 1e-5}) {
    INFO("a root at " << root << " that is off by " << off);
    CHECK(beyond(root, off) > 2.0 * off);    // the solution of the cut step crosses inside it
    CHECK(beyond(root, off) < 100.0 * off);  // and little is computed that is not kept
  }
  // A polynomial that seems exact: the end is another time, and as good as the root.
  CHECK(beyond(root, 0.0) > 64.0 * eps);
  CHECK(beyond(root, 0.0) < 2e-11);
  // A polynomial that says nothing.
  CHECK(beyond(root, 1.0) > 1e-3);
  CHECK(beyond(root, 1.0) < 0.05);
}

TEST_CASE("a step is not cut next to its begin, nor where the cut would be no shorter", "[radau]") {
  CHECK(cut_length(1e-2, 1.0, 1e-6) > 0.0);
  CHECK(cut_length(1e-4, 1.0, 1e-6) == 0.0);
  CHECK(cut_length(0.999, 1.0, 1e-6) > 0.0);
  CHECK(cut_length(0.9999, 1.0, 1e-3) == 0.0);
  CHECK(cut_length(1.0, 1.0, 0.0) == 0.0);
}

TEST_CASE("a step along the derivative is within the tolerance, and the derivative jumps in it",
          "[radau]") {
  CHECK(is_small(0.01));
  CHECK_FALSE(is_small(1.0));
  CHECK_FALSE(is_small(NAN));
  const Eigen::Vector2d f(3.0, 4.0);
  CHECK(jumps(f, Eigen::Vector2d(-3.0, -4.0)));        // a solution that slides
  CHECK_FALSE(jumps(f, Eigen::Vector2d(3.02, 4.02)));  // a smooth one turns by this in a step
  CHECK_FALSE(jumps(f, f));
}

TEST_CASE("absolute tolerances of ten times rtol |x| and more stand for rtol", "[radau]") {
  constexpr double rtol = 1e-6;
  const auto at = [](double k) { return relative_tolerance(rtol, 1.0 / (rtol * (1.0 + k))); };
  for (const double k : {0.0, 1.0, 8.0}) CHECK(at(k) == rtol);
  CHECK(std::abs(at(10.0) / rtol - 1.1) < 4.0 * eps);
  CHECK(std::abs(at(1e3) / rtol - 100.1) < 1e3 * eps);
  CHECK(relative_tolerance(rtol, 1e-3) == 1.0);  // states below their tolerance
}

TEST_CASE("Newton's iteration leaves a part of the error of a step, and no less than rounding",
          "[radau]") {
  for (const int stages : {3, 5, 7}) {
    const double fast = tuning::fast_error / stages;
    CHECK(newton_room(1e-6) <= 0.2 * fast);
    CHECK(newton_room(1e-6) >= 0.01 * fast);
  }
  // At 1e-14 a rounding of a state is a fiftieth of its tolerance.
  CHECK(newton_room(1e-14) >= 4.0 * eps / 1e-14);
  CHECK(newton_room(1e-14) <= 100.0 * eps / 1e-14);
}

TEST_CASE("a Jacobian is kept after an iteration that was short or contracted well", "[radau]") {
  const auto kept = [](int iterations, double theta) {
    Convergence newton(1e-12, 0.0, 7, 1e300);
    double correction = 1.0;
    for (int k = 0; k < iterations; ++k, correction *= theta) newton.look(correction);
    return newton.keeps_jacobian();
  };
  CHECK(kept(1, 0.5));
  CHECK(kept(2, 0.5));
  CHECK_FALSE(kept(3, 0.5));
  CHECK_FALSE(kept(3, 0.05));
  CHECK(kept(3, 1e-4));
}

TEST_CASE("a residual of some roundings of the state or of h f is rounding", "[radau]") {
  const double size = GENERATE(1e-3, 1.0, 1e6);
  for (const double roundings : {1.0, 20.0, 1e3, 1e6}) {
    const double residual = roundings * eps * size;
    INFO(roundings << " roundings of " << size);
    CHECK(rounding_explains(residual, size, 0.0, 0.0, 0.0) == (roundings <= 20.0));
    CHECK(rounding_explains(-residual, 0.0, 1.0, size, size) == (roundings <= 20.0));
  }
  CHECK_FALSE(rounding_explains(NAN, 1.0, 1.0, 1.0, 1.0));
}

TEST_CASE("the rounding of f is that of its argument times its slope", "[radau]") {
  // The slope of sin(1e8 x) at x = 1 is 1e8 at most, over an eighth of its period.
  const auto f = [](double x) { return std::sin(1e8 * x); };
  const double x = 1.0, h = 1.0, slope = 1e8;
  const double moved = f(slightly_changed(x));
  CHECK(rounding_explains(20.0 * eps * h * slope, x, h, f(x), moved));
  CHECK_FALSE(rounding_explains(1e3 * eps * h * slope, x, h, f(x), moved));
}

TEST_CASE("the contraction of a step counts in proportion to the length of the next one",
          "[radau]") {
  struct Row {
    double theta, ratio, expected;  // of theta
  };
  // No less than before for a shorter step; 1 for a step that need not contract at all.
  const Row rows[] = {{0.0, 8.0, 0.0},   {0.1, 1.0, 0.1}, {0.1, 0.01, 0.1}, {0.1, 8.0, 0.8},
                      {1e-6, 1e3, 1e-3}, {0.2, 8.0, 1.0}, {0.5, 2.0, 1.0},  {1.0, 3.0, 1.0}};
  const auto factor = [](double theta) { return theta / (1.0 - theta); };  // infinite for 1
  for (const Row& row : rows) {
    const double found = scaled(factor(row.theta), row.ratio);
    INFO("theta " << row.theta << ", ratio " << row.ratio);
    if (row.expected == 1.0)
      CHECK(std::isinf(found));
    else
      CHECK(std::abs(found / (1.0 + found) - row.expected) <= 8.0 * eps);
  }
}

TEST_CASE("a step without an error is followed by the longest allowed one, at every order",
          "[radau]") {
  const double order = GENERATE(4.0, 6.0, 8.0, 10.0, 12.0, 14.0), safety = 0.5;
  PredictiveControl control;
  CHECK(control.accept(0.0, 1.0, order, safety, false) == tuning::longest);
  CHECK(PredictiveControl::reject(0.0, 1.0, order, safety) == tuning::longest_retry);
}
