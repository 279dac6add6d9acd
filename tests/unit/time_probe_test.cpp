// TimeProbe: when called functions are asked whether they follow the time, and what is known then.
#include "saltus/solver/detail/time_probe.hpp"

#include "support/catch.hpp"

using namespace saltus;

TEST_CASE("called functions are asked again in ever more steps, until one follows the time",
          "[time_probe]") {
  TimeProbe probe;
  std::vector<int> asked;
  for (int step = 1; step <= 40; ++step)
    if (probe.is_due()) asked.push_back(step);
  CHECK(asked == std::vector<int>{1, 4, 16});
  probe.found = true;
  for (int step = 41; step <= 64; ++step) CHECK_FALSE(probe.is_due());
}

TEST_CASE("guards follow the time if the plan knows it, or if a look has shown it",
          "[time_probe]") {
  struct Row {
    FollowsTime known;
    bool found, follow;
  };
  constexpr Row rows[] = {
      {FollowsTime::no, false, false},      {FollowsTime::no, true, false},
      {FollowsTime::perhaps, false, false}, {FollowsTime::perhaps, true, true},
      {FollowsTime::yes, false, true},      {FollowsTime::yes, true, true},
  };
  for (const Row& row : rows) {
    TimeProbe probe;
    probe.found = row.found;
    INFO(static_cast<int>(row.known) << ' ' << row.found);
    CHECK(probe.follow(row.known) == row.follow);
  }
}
