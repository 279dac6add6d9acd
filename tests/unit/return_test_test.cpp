// ReturnTest: when a scene that was stiff is given back to an explicit method.
#include "saltus/solver/detail/return_test.hpp"

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr CheckPace pace{.every = 10, .first = 25, .reach = 1.0};

/// Steps of 1 s and their checks with |lambda| = `rate`; the steps until the return, -1: none.
int steps_until_return(ReturnTest& test, double rate, int most = 1000) {
  for (int i = 1; i <= most; ++i) {
    test.add_step(1.0);
    if (test.due(pace) && test.passes(rate, pace)) return i;
  }
  return -1;
}

ReturnTest begun() {
  ReturnTest test;
  test.begin_run();
  return test;
}

}  // namespace

TEST_CASE("a scene is given back after two checks at which its steps are stable", "[auto]") {
  ReturnTest slow = begun(), fast = begun(), unknown = begun();
  CHECK(steps_until_return(slow, 0.5) == 40);  // checks after 10, 20, 30, 40; two of them count
  CHECK(steps_until_return(fast, 2.0) == -1);
  CHECK(steps_until_return(unknown, NAN) == -1);
}

TEST_CASE("a check that fails begins the count anew", "[auto]") {
  ReturnTest test = begun();
  for (int i = 1; i <= 30; ++i) {
    test.add_step(1.0);
    if (test.due(pace)) CHECK_FALSE(test.passes(0.5, pace));
  }
  for (int i = 31; i <= 40; ++i) {
    test.add_step(1.0);
    if (test.due(pace)) CHECK_FALSE(test.passes(2.0, pace));
  }
  CHECK(steps_until_return(test, 0.5) == 20);
}

TEST_CASE("a return that did not last doubles the checks, up to a bound", "[auto]") {
  int before = 0;
  ReturnTest test = begun();
  for (int returns = 0; returns < 5; ++returns) {
    test.forget();
    const int steps = steps_until_return(test, 0.5);
    CHECK(steps > before);
    before = steps;
    test.be_patient();
  }
  for (int i = 0; i < 100; ++i) test.be_patient();
  test.forget();
  CHECK(steps_until_return(test, 0.5) < 1000);
  test.begin_run();  // another run has learnt nothing
  CHECK(steps_until_return(test, 0.5) == 40);
}

TEST_CASE("the longest step is that of the last two windows", "[auto]") {
  ReturnTest test = begun();
  test.add_step(3.0);
  for (int i = 0; i < 9; ++i) test.add_step(1.0);
  CHECK_FALSE(test.due(pace));  // too early, but its window ends
  CHECK(test.longest() == 3.0);
  for (int i = 0; i < 10; ++i) test.add_step(1.0);
  CHECK_FALSE(test.due(pace));
  CHECK(test.longest() == 1.0);
}
