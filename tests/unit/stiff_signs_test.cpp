// StiffSigns: whether the first steps after a restart are short because of stability.
#include "saltus/solver/detail/stiff_signs.hpp"

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("steps collapse by more than a new start shortens them", "[stiff_signs]") {
  // A new start is a hundredth of the time in which the states change by themselves, and grows by
  // five with each step: after two steps it is no shorter than a twentieth of the steps before.
  CHECK_FALSE(has_collapsed(0.05, 1.0));
  CHECK_FALSE(has_collapsed(2.0, 1.0));
  CHECK(has_collapsed(1e-3, 1.0));
  CHECK_FALSE(has_collapsed(1e-3, 0.0));  // there is none to compare with
}

TEST_CASE("steps several times beyond the bound of stability were never the method's own",
          "[stiff_signs]") {
  // The bound differs by a factor of three between directions of lambda, and an estimate of lambda
  // is good for its order of magnitude.
  const double stability = GENERATE(3.25, 6.0);
  CHECK_FALSE(is_far_beyond(stability, stability));
  CHECK_FALSE(is_far_beyond(3.0 * stability, stability));
  CHECK(is_far_beyond(100.0 * stability, stability));
}
