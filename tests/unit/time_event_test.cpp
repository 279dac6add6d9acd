// Time events: when they tick, how often, and what is refused.
#include "saltus/simulation/detail/calendar.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr std::int64_t endless = std::numeric_limits<std::int64_t>::max();

/// The times of the ticks in 0 s to 10 s.
std::vector<double> ticks(TimeEvent event) {
  event.name = "tick", event.update = count_up;
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_time_event(event);
  });
  const Results results = simulate(leaf, leaf.create_context(), {0.0, 10.0});
  const std::vector<double> times = results.events.times("tick", EventKind::time);
  CHECK(results.context.discrete_state()[0] == static_cast<double>(times.size()));
  return times;
}

std::string refused(const TimeEvent& event) {
  return message<ModelError>([&] { Leaf("leaf", [&](Leaf& l) { l.declare_time_event(event); }); });
}

}  // namespace

TEST_CASE("a time event ticks at its times, to its end, as often as its count", "[time_event]") {
  CHECK(ticks({.times = {{0.0, 0.5, 10.0}}}) == std::vector{0.0, 0.5, 10.0});
  CHECK(ticks({.times = {{-1.0, 3.0, 11.0}}}) == std::vector{3.0});
  CHECK(ticks({.times = std::vector<double>{}}).empty());
  CHECK(ticks({.times = {{1.0, 2.0, 3.0}}, .end = 2.0}) == std::vector{1.0, 2.0});
  CHECK(ticks({.times = {{1.0, 2.0, 3.0}}, .count = 1}) == std::vector{1.0});
  CHECK(ticks({.period = 4.0, .offset = 1.0}) == std::vector{1.0, 5.0, 9.0});
  CHECK(ticks({.period = 1.0, .end = 1.5}) == std::vector{0.0, 1.0});
  CHECK(ticks({.period = 1.0, .offset = 7.0, .count = 2}) == std::vector{7.0, 8.0});
  CHECK(ticks({.offset = 2.0}) == std::vector{2.0});
  CHECK(ticks({.offset = 2.0, .end = 1.0}).empty());
}

TEST_CASE("a tick at the end belongs to it, within the rounding of the calendar", "[time_event]") {
  CHECK(TimeEvent{.period = 0.1, .end = 0.3}.ticks() == 4);  // 3 * 0.1 > 0.3
  CHECK(TimeEvent{.period = 1.0 / 3.0, .end = 1000.0}.ticks() == 3001);
  CHECK(TimeEvent{.period = 0.1}.ticks() == endless);
  CHECK(TimeEvent{.period = 1e-300, .end = 1.0}.ticks() == endless);
  CHECK(TimeEvent{.period = 0.1, .count = 5}.ticks() == 5);
}

TEST_CASE("a calendar that begins within a list goes on from there", "[time_event]") {
  Plan plan;
  plan.schedule.push_back({.period = infinite, .ticks = 4, .times = {1.0, 2.0, 3.0, 5.0}});
  Calendar calendar(plan);
  calendar.begin(2.0, false);
  CHECK(calendar.next() == 2.0);
  calendar.begin(2.0, true);
  CHECK(calendar.next() == 3.0);
  std::vector<int> due;
  calendar.take(3.0, due);
  calendar.take(5.0, due);
  CHECK(due.size() == 1);
  CHECK(std::isinf(calendar.next()));
  calendar.begin(7.0, false);
  CHECK(std::isinf(calendar.next()));
}

TEST_CASE("times that make no sense are refused", "[time_event]") {
  CHECK(refused({.times = {{2.0, 1.0}}}) ==
        "block 'leaf': time event 'time_event_0': expected increasing times [s], found 1 after 2");
  CHECK(contains(refused({.times = {{1.0, 1.0}}}), "found 1 after 1"));
  CHECK(
      contains(refused({.times = {{1.0, not_a_number}}}), "expected finite times [s], found nan"));
  CHECK(contains(refused({.period = 1.0, .times = {{1.0}}}), "it has times and a period"));
  CHECK(contains(refused({.period = -1.0}), "expected period > 0"));
  CHECK(contains(refused({.period = 1.0, .count = 0}), "expected a count of 1 or more, found 0"));
  CHECK(contains(refused({.end = not_a_number}), "expected a time [s] as its end"));
}
