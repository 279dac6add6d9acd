// Decisions about blocks at rest, row by row of their tables.
#include "saltus/simulation/detail/contact_decisions.hpp"

#include <stdexcept>

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("A held guard stays within its error, releases on its armed side, is carried beyond it") {
  const int pressed = GENERATE(-1, 1);
  const double up = -pressed;  // towards the armed side
  CHECK(decide_held(0.0, 1e-12, pressed) == Held::stay);
  CHECK(decide_held(up * 1e-12, 1e-12, pressed) == Held::stay);
  CHECK(decide_held(up * 2e-12, 1e-12, pressed) == Held::release);
  CHECK(decide_held(up * -2e-12, 1e-12, pressed) == Held::stay);
  CHECK(decide_held(up * -2e-9, 1e-12, pressed) == Held::apply_again);
}

TEST_CASE("A relation at rest stays within its error, and while it is pressed") {
  const int pressed = GENERATE(-1, 1);
  CHECK(is_pressed(0.0, 0.0, pressed));
  CHECK(is_pressed(pressed * 1.0, 1e-12, pressed));
  CHECK(is_pressed(pressed * -1e-12, 1e-12, pressed));
  CHECK_FALSE(is_pressed(pressed * -2e-12, 1e-12, pressed));
}

TEST_CASE("A contact whose guard leaves its error is carried, wavers, or releases its blocks") {
  const int pressed = GENERATE(-1, 1);
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto unasked = []() -> bool { throw std::logic_error("asked whether it may be carried"); };
  CHECK(decide_waking(true, pressed * 1.0, pressed, unasked) == Waking::release);
  CHECK(decide_waking(false, pressed * -1.0, pressed, yes) == Waking::carry);
  CHECK(decide_waking(false, pressed * 1.0, pressed, no) == Waking::stay);
  CHECK(decide_waking(false, 0.0, pressed, no) == Waking::stay);
  CHECK(decide_waking(false, pressed * -1.0, pressed, no) == Waking::release);
}

TEST_CASE("A block lifts off where its flow pressed it on before, and leads off its surface now") {
  const bool carried = GENERATE(false, true), pressed_on = GENERATE(false, true);
  const double size = GENERATE(1e-300, 1.0);
  CHECK(decide_pressure(carried, pressed_on, -size) == Pressure{carried, true, false});
  CHECK(decide_pressure(carried, pressed_on, 0.0) == Pressure{carried, pressed_on, false});
  CHECK(decide_pressure(carried, true, size) == Pressure{false, true, true});
  CHECK(decide_pressure(carried, false, size) == Pressure{false, false, false});
}

TEST_CASE("The guard of a carried block is below zero until its lift is above") {
  CHECK(guard_of_lift(0.0) < 0.0);
  CHECK(guard_of_lift(-0.0) < 0.0);
  CHECK(guard_of_lift(5e-324) > 0.0);
  CHECK(guard_of_lift(-1.0) == -1.0);
}

TEST_CASE("A guard that wavered once stays at rest at the same value, and leaves at ten times it") {
  const int pressed = GENERATE(-1, 1);
  const double g = -pressed * 3e-12, error = error_after_wavering(1e-15, g);
  CHECK(decide_held(g, error, pressed) == Held::stay);
  CHECK(decide_held(-g, error, pressed) == Held::stay);
  CHECK(decide_held(10.0 * g, error, pressed) == Held::release);
  CHECK(error_after_wavering(1.0, g) == 1.0);  // an error never shrinks
}
