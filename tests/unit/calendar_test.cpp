// Calendar: ticks counted by integers, equal times one instant, no tick twice, none lost.
#include "saltus/simulation/detail/calendar.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A plan of nothing but schedules (period, offset).
Plan schedules(const std::vector<std::pair<double, double>>& events) {
  Plan plan;
  for (const auto& [period, offset] : events) plan.schedule.push_back({0, 0, period, offset, ""});
  return plan;
}

}  // namespace

TEST_CASE("a thousand ticks of 1/3 s are where integers put them", "[calendar]") {
  const Plan plan = schedules({{1.0 / 3.0, 0.0}});
  Calendar calendar(plan);
  calendar.begin(0.0, false);
  std::vector<int> due;
  for (int k = 0; k < 1000; ++k) {
    CHECK(calendar.next() == static_cast<double>(k) * (1.0 / 3.0));
    calendar.take(calendar.next(), due);
    CHECK(due.size() == 1);
  }
}

TEST_CASE("times that differ by rounding only are one instant", "[calendar]") {
  const Plan plan = schedules({{0.1, 0.0}, {0.3, 0.0}, {infinite, 0.3}});
  Calendar calendar(plan);
  calendar.begin(0.25, false);
  CHECK(calendar.next() == 0.3);
  std::vector<int> due;
  calendar.take(calendar.next(), due);  // 3 * 0.1 is 0.30000000000000004
  CHECK(due == std::vector{0, 1, 2});
  CHECK(calendar.next() == 0.4);
  CHECK(calendar.due(0.4));
  CHECK(!calendar.due(0.39999));
}

TEST_CASE("a run that begins at a tick has it; one that goes on from there has not", "[calendar]") {
  const Plan plan = schedules({{0.5, 0.25}});
  Calendar calendar(plan);
  calendar.begin(0.75, false);
  CHECK(calendar.next() == 0.75);
  calendar.begin(0.75, true);
  CHECK(calendar.next() == 1.25);
  calendar.begin(0.0, true);
  CHECK(calendar.next() == 0.25);
  calendar.begin(-10.0, false);
  CHECK(calendar.next() == 0.25);  // no tick before the offset
  calendar.begin(1e9, false);
  CHECK(calendar.next() == 1e9 + 0.25);
}

TEST_CASE("a single event at an infinite period happens once", "[calendar]") {
  const Plan plan = schedules({{infinite, 2.0}});
  Calendar calendar(plan);
  std::vector<int> due;
  calendar.begin(0.0, false);
  CHECK(calendar.next() == 2.0);
  calendar.take(2.0, due);
  CHECK(due.size() == 1);
  CHECK(calendar.next() == infinite);
  calendar.begin(2.0, true);
  CHECK(calendar.next() == infinite);
  calendar.begin(3.0, false);
  CHECK(calendar.next() == infinite);
}

TEST_CASE("without schedules the next time is never", "[calendar]") {
  const Plan plan = schedules({});
  Calendar calendar(plan);
  calendar.begin(0.0, false);
  CHECK(calendar.next() == infinite);
}
