// Calendar: ticks counted by integers, equal times one instant, no tick twice, none lost.
#include "saltus/simulation/detail/calendar.hpp"

#include "saltus/plan/compile.hpp"
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

TEST_CASE(
    "A root may be at the next time event within a ten-thousandth of its step, or within "
    "rounding") {
  const Leaf leaf("leaf", [](Leaf& l) { l.declare_one_shot(2.0, {}, "tick"); });
  const auto plan = compile(leaf);
  Calendar calendar(*plan);
  calendar.begin(0.0, false);
  CHECK(calendar.stop_at_root(1.0, 2.0 - 0.9e-4) == 2.0);
  CHECK(calendar.stop_at_root(1.0, 2.0 - 1.1e-4) == 2.0 - 1.1e-4);
  const double near = 2.0 - 60.0 * 2.0 * eps, far = 2.0 - 70.0 * 2.0 * eps;
  CHECK(calendar.stop_at_root(near, near) == 2.0);
  CHECK(calendar.stop_at_root(far, far) == far);
  CHECK(calendar.stop_at_root(1.0, 2.5) == 2.5);
  std::vector<int> due;
  calendar.take(2.0, due);
  CHECK(calendar.stop_at_root(2.0, 3.0) == 3.0);  // there is no other one
}

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

TEST_CASE("an instant has the time of a counted tick, if there is one", "[calendar]") {
  // A leaf whose discrete state is the time of its next event, one rounding before the tick at 0.3.
  const double early = std::nextafter(0.3, 0.0);
  const Leaf leaf("leaf", [&](Leaf& l) {
    l.declare_discrete_state(vec({early}));
    l.declare_time_event(
        {.name = "by state",
         .update = [](const At& at, Next& next) { next.set_discrete_state(at.z + vec({1.0})); },
         .next = [](const VectorView& z) { return z[0]; }});
    l.declare_periodic_update([](const At& at, Next& next) { next.set_discrete_state(at.z); }, 0.3,
                              0.3);
  });
  const std::shared_ptr<const Plan> plan = compile(leaf);
  const Eigen::VectorXd z = vec({early}), other = vec({0.2});
  Calendar calendar(*plan, &z), apart(*plan, &other);
  calendar.begin(0.0, false), apart.begin(0.0, false);
  CHECK(calendar.next() == 0.3);
  CHECK(apart.next() == 0.2);
  CHECK(calendar.stop(early) == 0.3);  // no step ends one rounding before a tick
  CHECK(calendar.stop(0.29) == 0.29);
  CHECK(calendar.stop(infinite) == 0.3);
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

/// The discrete state says when the next tick is, and an update moves it on.
TEST_CASE("ticks that follow from the discrete state", "[calendar]") {
  Plan plan = schedules({{infinite, 0.0}});
  auto declarations = std::make_shared<Declarations>();
  declarations->time_events.push_back({.next = [](const VectorView& z) { return z[0]; }});
  plan.leaves.push_back({.nz = 1, .declarations = declarations});
  plan.schedule[0].by_state = true;
  Eigen::VectorXd z = Eigen::VectorXd::Constant(1, 0.7);
  Calendar calendar(plan, &z);
  calendar.begin(5.0, true);
  CHECK(calendar.next() == 0.7);
  std::vector<int> due;
  calendar.take(0.6, due);
  CHECK(due.empty());
  calendar.take(0.7, due);
  CHECK(due == std::vector{0});
  z[0] = infinite;
  CHECK(!calendar.due(1e9));
}
