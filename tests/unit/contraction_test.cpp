// Adams' corrector: a slow iteration is refused, a fast one gets the whole tolerance, and the ratio
// is remembered as CVODE remembers its own.
#include "saltus/solver/detail/contraction.hpp"

#include "saltus/solver/detail/fixed_length.hpp"
#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinRel;

namespace {

/// Two changes of an iteration: one tolerance, and this part of it. Returns whether it goes on.
bool goes_on(double ratio, double tolerance = 0.1) {
  Contraction iteration;
  REQUIRE(iteration.look(1.0, true, tolerance));
  return iteration.look(ratio, false, tolerance);
}

/// The share of the tolerance after an iteration with this ratio.
double share(double ratio) {
  Contraction iteration;
  iteration.look(1.0, true, 0.1);
  REQUIRE(iteration.look(ratio, false, 0.1));
  return iteration.share();
}

}  // namespace

// The error after a step is at most q / (1 - q) times the last change; it is below half of that
// change up to q = 1/3.
TEST_CASE("an iteration goes on if its rest is below half of its last change", "[adams]") {
  for (const double q : {0.0, 0.05, 0.1, 0.29}) CHECK(goes_on(q));
  for (const double q : {1.0 / 3.0, 0.5, 1.0, 1.9, 30.0}) CHECK_FALSE(goes_on(q));
}

TEST_CASE("a change within a hundredth of the tolerance of the iteration is not judged",
          "[adams]") {
  CHECK(goes_on(0.9, 100.0));
  CHECK_FALSE(goes_on(0.9, 80.0));
}

TEST_CASE("the first change of a step is not compared with the last one of the step before",
          "[adams]") {
  Contraction iteration;
  iteration.look(1e-3, true, 0.1);
  CHECK(iteration.look(1e3, true, 0.1));
  CHECK(iteration.share() == 1.0);
}

TEST_CASE("the tolerance shrinks with the cube of the ratio, from a tenth on", "[adams]") {
  for (const double q : {0.0, 0.01, 0.099}) CHECK(share(q) == 1.0);
  CHECK_THAT(share(0.2), WithinRel(0.125 * 0.8, 1e-14));
  CHECK_THAT(share(0.25), WithinRel(0.064 * 0.75, 1e-14));
}

// CVODE remembers max(0.3 q, the new ratio): CRDOWN, cvode_nls.c.
TEST_CASE("the ratio falls to three tenths at most from one change to the next", "[adams]") {
  Contraction iteration;
  iteration.look(1.0, true, 0.1);
  iteration.look(0.2, false, 0.1);
  iteration.look(0.0, false, 0.1);
  CHECK_THAT(iteration.ratio(), WithinRel(0.06, 1e-14));
  iteration.look(1.0, true, 0.1);
  iteration.look(0.05, false, 0.1);
  CHECK_THAT(iteration.ratio(), WithinRel(0.05, 1e-14));
}

// A change too small to be judged may have any ratio; the remembered one is that of the slowest
// iteration that goes on.
TEST_CASE("a ratio that is not judged counts as the slowest one that is accepted", "[adams]") {
  Contraction iteration;
  iteration.look(1e-5, true, 0.1);
  CHECK(iteration.look(1e-4, false, 0.1));
  CHECK(goes_on(0.999 * iteration.ratio()));
  CHECK_FALSE(goes_on(1.001 * iteration.ratio()));
}

TEST_CASE("vectors of up to sixteen states have operations of their own", "[adams]") {
  for (const Index n : {1, 2, 16}) CHECK(has_fixed_length(n));
  for (const Index n : {0, 17, 160}) CHECK_FALSE(has_fixed_length(n));
}
