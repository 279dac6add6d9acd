// Present: the facts about guards last for an instant, and their firings for a pass.
#include "saltus/simulation/detail/present.hpp"

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("an instant finds no facts of the one before", "[present]") {
  Present present(3);
  present.open(1.0, 9.0);
  present.note(0).frozen = true;
  present.note(2).flips = 2;
  present.note(2).put_at_zero = true;
  present.fires_in_pass(1);
  present.fire(1, -1);
  present.outcome.restart = true;
  present.open(2.0, 8.0);
  for (const std::size_t k : {0, 1, 2}) {
    CHECK_FALSE(present.now(k).frozen);
    CHECK(present.now(k).flips == 0);
    CHECK_FALSE(present.now(k).put_at_zero);
    CHECK_FALSE(present.now(k).fired);
    CHECK_FALSE(present.now(k).fired_in_pass);
  }
  CHECK(present.firings.empty());
  CHECK_FALSE(present.outcome.restart);
}

TEST_CASE("a guard with facts has them again in a later instant", "[present]") {
  Present present(2);
  for (const double t : {1.0, 2.0, 3.0}) {
    present.open(t, 1.0);
    CHECK(present.now(1).flips == 0);
    ++present.note(1).flips, ++present.note(1).flips;
    CHECK(present.now(1).flips == 2);
  }
}

TEST_CASE("a pass forgets which guards fired in the last one, and the instant does not",
          "[present]") {
  Present present(2);
  present.open(1.0, 9.0);
  present.open_pass();
  present.fires_in_pass(0);
  present.open_pass();
  present.fires_in_pass(1);
  CHECK(present.now(0).fired);
  CHECK_FALSE(present.now(0).fired_in_pass);
  CHECK(present.now(1).fired);
  CHECK(present.now(1).fired_in_pass);
}
