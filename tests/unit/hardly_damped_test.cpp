// Fast parts that are hardly damped, beside which a multistep method adds up its errors.
#include "saltus/solver/detail/hardly_damped.hpp"

#include "support/catch.hpp"

using namespace saltus::cvode;

TEST_CASE("which parts BDF amplifies", "[hardly_damped]") {
  struct Row {
    int order;
    double reach, damping;
    bool expected;
  };
  for (const Row& row : {Row{2, 3.0, 0.0, false},
                         {3, 1.5, 0.0, true},
                         {3, 1.5, 0.1, false},
                         {4, 3.0, 0.1, true},
                         {4, 3.0, 0.5, false},
                         {5, 3.0, 0.5, true},
                         {5, 3.0, 0.7, false},
                         {5, 3.0, 1.0, false},
                         {5, 0.2, 0.0, false},
                         {5, 9.0, 0.0, true},
                         {5, 50.0, 0.0, false},
                         {1, 3.0, -0.1, false}}) {
    CAPTURE(row.order, row.reach, row.damping);
    CHECK(bdf_amplifies(row.order, row.reach, row.damping) == row.expected);
  }
}

TEST_CASE("when the corrector of Adams bounds the steps beside an oscillation", "[hardly_damped]") {
  CHECK(adams_is_bounded(0.25, 0.0));
  CHECK(adams_is_bounded(0.5, 0.16));
  CHECK_FALSE(adams_is_bounded(0.06, 0.0));
  CHECK_FALSE(adams_is_bounded(0.5, 0.7));
  CHECK_FALSE(adams_is_bounded(0.5, 1.0));
}

TEST_CASE("looks are after 32 steps, 64, 128, and two of them are needed", "[hardly_damped]") {
  Doubt doubt;
  for (int step = 1; step <= 300; ++step)
    CHECK(doubt.is_due() == (step == 32 || step == 64 || step == 128 || step == 256));
  doubt.note(true, 30.0);
  doubt.note(false, 90.0);
  CHECK_FALSE(doubt.is_sure());
  doubt.note(true, 20.0);
  CHECK(doubt.is_sure());
  CHECK(doubt.rate() == 30.0);
  CHECK(doubt.words().starts_with("beside an oscillation of 30 rad/s"));
  doubt.begin();
  CHECK_FALSE(doubt.is_sure());
}
