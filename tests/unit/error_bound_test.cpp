// The error bound of a guard, row by row of its tables.
#include "saltus/simulation/detail/error_bound.hpp"

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("A root bounds the movement of its guard by its value; a jump has none") {
  CHECK(location_error(-1e-16, false) == 4e-16);
  CHECK(location_error(1e-16, false) == 4e-16);
  CHECK(location_error(-1.0, true) == 0.0);
}

TEST_CASE("The error bound before the flow is asked") {
  const ErrorFacts fired{.g = -2e-16, .location = 4e-16, .fired = true};
  ErrorFacts left = fired, jumped = fired;
  left.left_error = true;
  jumped.location = location_error(-1.0, true), jumped.g = -1.0;
  CHECK(error_so_far(fired) == 4e-16);
  CHECK(error_so_far(left) == 1.01 * 2e-16);
  CHECK(error_so_far(jumped) == 0.0);
  CHECK(error_so_far({.g = -3e-12, .counts_as_zero = true}) == 3e-12);
  CHECK(error_so_far({.g = -3e-12}) == 0.0);
  // A firing counts before a mode that was entered in the same instant.
  CHECK(error_so_far({.g = -3e-12, .location = 4e-16, .fired = true, .counts_as_zero = true}) ==
        4e-16);
}

TEST_CASE("The guard of a contact has the largest of its errors") {
  CHECK(contact_error(1e-15, -3e-15, 2e-15) == 3e-15);
  CHECK(contact_error(4e-15, 3e-15, 2e-15) == 4e-15);
  CHECK(contact_error(1e-15, 0.0, 2e-15) == 2e-15);
  CHECK(contact_error(1e-15, 2.0, 0.0, 1.0) == 3.0);  // a guard that jumps from 3 to 2
  CHECK(contact_error(1e-15, 0.0, 0.0, 1.0) == 1.0);  // from 1 to 0
}
