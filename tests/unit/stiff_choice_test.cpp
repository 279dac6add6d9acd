// The choice between Radau and BDF, and the return to the explicit method: tables.
#include "saltus/solver/detail/stiff_choice.hpp"
#include "saltus/solver/detail/return_test.hpp"
#include "support/leaves.hpp"

using namespace saltus;

namespace {

constexpr double impossible = -1.0;

/// The choice where a factorisation takes this long [ns] for each state; `impossible`: there is
/// none.
StiffMethod choice(const StiffScene& scene, double time) {
  const auto cost = [&] { return MatrixCost{time != impossible, time * scene.states}; };
  return choose_stiff_method(scene, cost).method;
}

}  // namespace

TEST_CASE("the stiff method follows from size, tolerance, damping, events and matrices", "[auto]") {
  using enum StiffMethod;
  const auto row = [](const StiffScene& scene, StiffMethod cheap, StiffMethod dear,
                      StiffMethod matrix_free) {
    INFO(scene.states << " states, rtol " << scene.rtol << ", hardly damped " << scene.hardly_damped
                      << ", many events " << scene.many_events);
    CHECK(choice(scene, 30.0) == cheap);
    CHECK(choice(scene, 3000.0) == dear);
    CHECK(choice(scene, impossible) == matrix_free);
  };
  // A few states: always, at any cost.
  row({.states = 16, .rtol = 1e-3}, radau, radau, bdf);
  row({.states = 17, .rtol = 1e-3}, bdf, bdf, bdf);
  // A tight tolerance, where the matrices are cheap.
  row({.states = 1000, .rtol = 1e-7}, radau, bdf, bdf);
  row({.states = 1000, .rtol = 2e-7}, bdf, bdf, bdf);
  // Frequent events, where the matrices are cheap.
  row({.states = 1000, .rtol = 1e-3, .many_events = true}, radau, bdf, bdf);
  // The imaginary axis: BDF is unstable there.
  row({.states = 1000, .rtol = 1e-3, .hardly_damped = true}, radau, radau, none);
  row({.states = 2, .rtol = 1e-9, .hardly_damped = true}, radau, radau, none);
}

TEST_CASE("the matrices are looked at only where the choice depends on them", "[auto]") {
  int looks = 0;
  const auto cost = [&] { return ++looks, MatrixCost{}; };
  choose_stiff_method({.states = 1000, .rtol = 1e-3}, cost);
  CHECK(looks == 0);
  choose_stiff_method({.states = 2}, cost);
  CHECK(looks == 1);
}

TEST_CASE(
    "the explicit method returns after checks in a row, twice as many each time it was too soon",
    "[auto]") {
  const CheckPace pace{.every = 10, .first = 20, .reach = 2.0};
  ReturnTest test;
  test.begin_run();
  /// The steps of 1 s until the test passes with |lambda| = 1 / s; 0: not within 1000.
  const auto steps_until = [&](double rate) {
    for (int i = 1; i <= 1000; ++i) {
      test.add_step(1.0);
      if (test.due(pace) && test.passes(rate, pace)) return i;
    }
    return 0;
  };
  CHECK(steps_until(1.0) == 30);  // checks after 20 and 30 steps
  test.forget();
  CHECK(steps_until(3.0) == 0);  // beyond the reach
  test.forget(), test.be_patient();
  CHECK(steps_until(1.0) == 50);  // four checks
  test.forget();
  CHECK(test.longest() == 0.0);
  test.add_step(0.5), test.add_step(0.25);
  CHECK(test.longest() == 0.5);
}
