// How CVODE starts: which flights it leaves to a one-step method.
#include "saltus/solver/detail/cvode_start.hpp"

#include <cfloat>

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("a flight of a few steps of order 1 is left to a one-step method, a long one is not",
          "[cvode]") {
  // Steps of order 1 grow by ten from one to the next at most: a thousand first steps are four of
  // them, of orders up to 3. A million are as many as a whole run may have.
  const double first = GENERATE(1e-12, 1.0);
  CHECK(cvode::is_event_near(first, first));
  CHECK(cvode::is_event_near(1e3 * first, first));
  CHECK_FALSE(cvode::is_event_near(1e6 * first, first));
  CHECK_FALSE(cvode::is_event_near(1.0, 0.0));  // no step has been taken yet
}

TEST_CASE("the one-step method flies past the expected event, but not for long", "[cvode]") {
  // An event that comes half as late again as expected is within its flight.
  CHECK(cvode::start_ends(2.0, 0.5) > 2.75);
  CHECK(cvode::start_ends(2.0, 0.5) < 7.0);  // ten times the time expected
}

TEST_CASE("a flight is stiff if BDF takes fewer steps, with its start", "[cvode]") {
  // An explicit method takes a step per 3.25 time constants of the fastest part at most, and BDF
  // starts in 13 to 27 steps.
  CHECK_FALSE(cvode::is_flight_stiff(3.25, 13.0));
  CHECK(cvode::is_flight_stiff(3.25, 300.0));
  CHECK_FALSE(cvode::is_flight_stiff(0.0, 1e300));
}

TEST_CASE("CVODE takes no step within the rounding of the time, nor of the least doubles",
          "[cvode]") {
  const double time = GENERATE(1e-3, 1.0, 1e9);
  CHECK(cvode::shortest_step(time) > 4.0 * DBL_EPSILON * time);  // t + h has two digits of h
  CHECK(cvode::shortest_step(time) < 1e3 * DBL_EPSILON * time);
  // Quotients of full precision of the step are no denormal numbers.
  CHECK(cvode::shortest_step(0.0) > DBL_MIN / DBL_EPSILON);
  CHECK(cvode::shortest_step(0.0) < 1e3 * DBL_MIN / DBL_EPSILON);
}

TEST_CASE("the first two steps are of order 1", "[cvode]") {
  CHECK(cvode::is_coarse(0));
  CHECK(cvode::is_coarse(1));
  CHECK_FALSE(cvode::is_coarse(3));
}

TEST_CASE("the product of two values shown to CVODE is a normal number", "[cvode]") {
  const double shown = thresholds::least_shown;
  CHECK(shown * shown >= DBL_MIN);
  CHECK(shown < 1e-90);  // a guard of that size is as good as at zero for any author
}
