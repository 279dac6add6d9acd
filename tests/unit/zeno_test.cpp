// ZenoMonitor: shrinking gaps accumulate, equal ones never; the sum of the series is predicted.
#include "saltus/simulation/detail/zeno.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;
using Catch::Matchers::WithinRel;

namespace {

/// A monitor that saw firings at `start` and then after each gap.
ZenoMonitor seen(double tolerance, double start, const std::vector<double>& gaps) {
  ZenoMonitor monitor(tolerance);
  double t = start;
  monitor.fired(t);
  for (const double gap : gaps) monitor.fired(t += gap);
  return monitor;
}

}  // namespace

TEST_CASE("a gap has to be short beside the longest one, if a share of it is given",
          "[unit][zeno]") {
  ZenoMonitor monitor(1e-6, 0.0, 1e-3);
  double t = 0.0;
  monitor.fired(t);
  for (double gap = 8e-7; gap > 8.1e-10; gap *= 0.5) {
    monitor.fired(t += gap);
    CHECK(!monitor.accumulates());
  }
  monitor.fired(t += 7.8e-10);
  CHECK(monitor.accumulates());

  ZenoMonitor resumed(1e-6, 0.0, 1e-3);
  resumed.load(monitor.save(), 0);
  CHECK(resumed.accumulates());
  monitor.forget();
  for (const double gap : {4e-8, 2e-8, 1e-8, 5e-9}) monitor.fired(t += gap);
  CHECK(!monitor.accumulates());  // a new series with a longest gap of its own
}

TEST_CASE("gaps that shrink geometrically below the tolerance accumulate", "[zeno]") {
  const double start = GENERATE(0.0, -3.0, 100.0);
  CHECK(seen(1e-6, start, {8e-7, 4e-7, 2e-7}).accumulates());
  CHECK(seen(1e-6, start, {1e-3, 1e-5, 1e-7}).accumulates());
  CHECK(!seen(1e-6, start, {8e-3, 4e-3, 2e-3}).accumulates());  // not there yet
  CHECK(!seen(1e-6, start, {4e-7, 2e-7}).accumulates());        // two gaps say nothing
  CHECK(!seen(1e-6, start, {}).accumulates());
}

TEST_CASE("equal, growing and wavering gaps never accumulate, however short", "[zeno]") {
  CHECK(!seen(1e-6, 0.0, {1e-7, 1e-7, 1e-7, 1e-7}).accumulates());
  CHECK(!seen(1e-6, 0.0, {1e-9, 2e-9, 3e-9}).accumulates());
  CHECK(!seen(1e-6, 0.0, {3e-7, 1e-7, 2e-7}).accumulates());
  CHECK(!seen(1e-6, 0.0, {3e-7, 2e-7, 2e-7}).accumulates());
}

TEST_CASE("short gaps after a long one do not accumulate before they have one ratio", "[zeno]") {
  CHECK(!seen(1e-6, 0.0, {2.1, 1.9, 1e-7}).accumulates());
  CHECK(!seen(1e-6, 0.0, {5.0, 2e-8, 2e-12}).accumulates());
  CHECK(seen(1e-6, 0.0, {5.0, 4e-8, 2e-8, 1e-8}).accumulates());
  // The ratios 0.04 and 0.5, and in the other order; 0.2 and 0.5.
  CHECK(!seen(1e-6, 0.0, {1e-6, 0.04e-6, 0.02e-6}).accumulates());
  CHECK(!seen(1e-6, 0.0, {1e-6, 0.5e-6, 0.02e-6}).accumulates());
  CHECK(seen(1e-6, 0.0, {1e-6, 0.2e-6, 0.1e-6}).accumulates());
}

TEST_CASE("gaps that approach a length above zero do not accumulate", "[zeno]") {
  const auto approach = [](double length, double q) {
    std::vector<double> gaps;
    for (int k = 0; k < 40; ++k) gaps.push_back(length + 1e-7 * std::pow(q, k));
    return seen(1e-6, 0.0, gaps).accumulates();
  };
  CHECK(!approach(5e-7, 0.9));
  CHECK(!approach(5e-7, 0.99));
  CHECK(approach(0.0, 0.9));
  // Slower than geometric: gaps that fall as 1 / k^2.
  std::vector<double> gaps;
  for (int k = 1; k < 100; ++k) gaps.push_back(1e-6 / (k * k));
  CHECK(seen(1e-6, 0.0, gaps).accumulates());
}

TEST_CASE("gaps that shrink by rounding only do not accumulate", "[zeno]") {
  // At t = 1e3 s a time is rounded to 1e-13 s: a steady rhythm of 1e-7 s wavers by that.
  CHECK(!seen(1e-6, 1e3, {1e-7, 1e-7 - 1e-13, 1e-7 - 2e-13}).accumulates());
}

TEST_CASE("gaps that shrink by more than eight roundings of the time accumulate", "[zeno]") {
  // At 1024 s a rounding is 2^-42 s, and all of these times are exact.
  const double rounding = 1024.0 * eps;
  const auto shrinking_by = [&](double step) {
    return seen(1.0, 1024.0,
                {100.0 * rounding, (100.0 - step) * rounding, (100.0 - 2.0 * step) * rounding});
  };
  CHECK(!shrinking_by(7.0).accumulates());
  CHECK(shrinking_by(9.0).accumulates());
}

TEST_CASE("the ratio of a slow series is that over two gaps", "[zeno]") {
  const auto remainder = [](double q) { return q / (1.0 - q); };
  // 0.92 / 0.97 > 0.9: the square root of 0.92 / 1. Otherwise the ratio of the last two gaps.
  CHECK_THAT(seen(10.0, 0.0, {1.0, 0.97, 0.92}).remainder(),
             WithinRel(remainder(std::sqrt(0.92)), 1e-12));
  CHECK_THAT(seen(10.0, 0.0, {1.0, 0.5, 0.44}).remainder(), WithinRel(remainder(0.88), 1e-12));
}

TEST_CASE("the accumulation time and state of a geometric series are exact", "[zeno]") {
  const double q = GENERATE(0.1, 0.5, 0.9);
  ZenoMonitor monitor(1.0);
  Eigen::VectorXd after(2);
  double t = 2.0, gap = 0.1, v = 1.0;
  for (int k = 0; k < 6; ++k) {
    monitor.fired(t);
    after << 3.0, v;
    if (k < 5) monitor.remember(after);
    if (k < 5) t += gap, gap *= q, v *= q;
  }
  // t_k + gap q / (1 - q), the sum of all later gaps. Gaps of 1e-6 s between times of 2 s are known
  // to 4e-16 / 1e-6.
  CHECK_THAT(monitor.accumulation_time(), WithinRel(2.0 + 0.1 / (1.0 - q), 1e-9));
  monitor.accumulate(after);
  CHECK(after[0] == 3.0);
  CHECK(std::abs(after[1]) < 1e-6);
}

TEST_CASE("the first firing has no gap; forgetting makes it the first again", "[zeno]") {
  ZenoMonitor monitor(1e-6);
  CHECK(monitor.gap() == infinite);
  monitor.fired(0.0);
  CHECK(monitor.gap() == infinite);
  CHECK(!monitor.accumulates());
  monitor = seen(1e-6, 5.0, {8e-7, 4e-7, 2e-7});
  monitor.forget();
  CHECK(monitor.gap() == infinite);
  monitor.fired(5.0);
  CHECK(!monitor.accumulates());
}

TEST_CASE("a steady fast rhythm in a run is no Zeno hold", "[zeno]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  // A sawtooth of 5e-7 s, below the tolerance of 1e-6 s.
  const Leaf saw("saw", [](Leaf& l) {
    declare_ramp(l);
    l.declare_zero_crossing(
        {.name = "full",
         .guard = [](const At& at) { return at.x[0] - 5e-7; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); }});
  });
  const auto results =
      simulate(saw, saw.create_context(), {0.0, 1e-3}, {.ode_solver_method = method});
  CHECK(count(results.events, EventKind::zeno_enter) == 0);
  CHECK(count(results.events, EventKind::zero_crossing) >= 1999);
}

TEST_CASE("a zero tolerance switches the monitor off", "[zeno]") {
  CHECK(!ZenoMonitor(0.0).on());
  CHECK(ZenoMonitor(1e-6).on());
}

TEST_CASE("a monitor that was saved goes on as it would have", "[zeno]") {
  ZenoMonitor monitor = seen(1e-6, 5.0, {8e-7, 4e-7, 2e-7});
  monitor.remember(Eigen::VectorXd::Constant(1, 3.0));
  monitor.holding = true;
  ZenoMonitor loaded(1e-6);
  loaded.fired(1.0);
  loaded.load(monitor.save(), 1);
  CHECK(loaded.holding);
  CHECK(loaded.gap() == monitor.gap());
  CHECK(loaded.accumulates());
  CHECK(loaded.accumulation_time() == monitor.accumulation_time());
  Eigen::VectorXd one = Eigen::VectorXd::Constant(1, 2.0), other = one;
  monitor.accumulate(one), loaded.accumulate(other);
  CHECK(one == other);
  CHECK(loaded.save() == monitor.save());
  CHECK(ZenoMonitor(1e-6).save().times.empty());
}

TEST_CASE("firings without the state after the latest do not count in a monitor", "[zeno]") {
  ZenoMonitor monitor = seen(1e-6, 5.0, {8e-7, 4e-7, 2e-7});
  monitor.holding = true;
  ZenoMonitor loaded(1e-6);
  loaded.load(monitor.save(), 1);
  CHECK(loaded.holding);
  CHECK(loaded.save().times.empty());
  CHECK(!loaded.accumulates());
}
