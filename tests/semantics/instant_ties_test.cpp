// Semantics 3.1: a crossing and a time event at one time are one instant, whatever the rounding of the method.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr double period = 0.1;

/// x = start + rate t reaches its level at tick n, up to rounding.
struct Tie {
  double rate, start;
  int n;
  double time() const { return n * period; }
  double level() const { return start + rate * time(); }
};

std::vector<Tie> ties() {
  std::vector<Tie> all;
  for (const double rate : {1.0, -1.0 / 3.0, 7.3})
    for (const double start : {0.0, 2.7, -31.1})
      for (const int n : {1, 2, 3, 6, 7, 11, 23, 30}) all.push_back({rate, start, n});
  return all;
}

/// z0 counts crossings of the level. z1 counts the ticks at which the relation "above" was true, and z2 is
/// the sum of what the ticks read of z0.
Leaf sampled(const Tie& tie) {
  return Leaf("sampled", [=](Leaf& l) {
    const auto height = [=](const At& at) {
      return (at.x[0] - tie.level()) * (tie.rate > 0 ? 1 : -1);
    };
    const RelationIndex above = l.declare_relation({.name = "above", .guard = height});
    declare_ramp(l, tie.rate, tie.start);
    l.declare_discrete_state(vec({0.0, 0.0, 0.0}));
    l.declare_periodic_update(
        [=](const At& at, Next& next) {
          next.set_discrete_state(
              {at.z[0], at.z[1] + (at.relation(above) ? 1.0 : 0.0), at.z[2] + at.z[0]});
        },
        period, period, "tick");
    l.declare_zero_crossing({.name = "reached", .guard = height, .reset_map = count_up});
    l.declare_zero_crossing({.name = "monitor", .guard = height});
    l.declare_zero_crossing({.name = "truth",
                             .guard = [=](const At& at) { return height(at) >= 0.0 ? 1.0 : -1.0; },
                             .direction = Direction::negative_then_non_negative});
  });
}

/// Runs to half a period after tick n, and one more.
Results run(const Leaf& leaf, const Tie& tie, Method method) {
  return simulate(leaf, leaf.create_context(), {0.0, tie.time() + 1.5 * period},
                  {.rtol = 1e-9, .atol = 1e-12, .ode_solver_method = method});
}

std::string words(const Tie& tie) {
  return text("rate ", tie.rate, ", start ", tie.start, ", tick ", tie.n);
}

/// A chain of passes: x at its level sets z0, which sets z1, which carries x off its level, further in the
/// direction of the crossing.
Leaf chained(const Tie& tie) {
  return Leaf("chained", [=](Leaf& l) {
    declare_ramp(l, tie.rate, tie.start);
    l.declare_discrete_state(vec({0.0, 0.0}));
    l.declare_periodic_update([](const At&, Next&) {}, period, period, "tick");
    l.declare_zero_crossing(
        {.name = "reached",
         .guard = [=](const At& at) { return at.x[0] - tie.level(); },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({1.0, at.z[1]}); }});
    l.declare_zero_crossing(
        {.name = "second",
         .guard = [](const At& at) { return at.z[0] - 0.5; },
         .reset_map = [](const At& at, Next& next) { next.set_discrete_state({at.z[0], 1.0}); }});
    l.declare_zero_crossing(
        {.name = "third",
         .guard = [](const At& at) { return at.z[1] - 0.5; },
         .reset_map = [=](const At&,
                          Next& next) { next.set_continuous_state({tie.level() + tie.rate}); }});
  });
}

}  // namespace

TEST_CASE(
    "3.1 a crossing within rounding of a tick belongs to it: the tick reads its relation, not its "
    "reset",
    "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Tie& tie : ties()) {
    INFO("method " << method << ", " << words(tie));
    const Leaf leaf = sampled(tie);
    const Results results = run(leaf, tie, method);
    // At tick n the relation has flipped, and z0 is that before the instant; at tick n + 1 both are seen.
    CHECK(results.context.discrete_state() == vec({1.0, 2.0, 1.0}));
    for (const char* name : {"reached", "monitor", "truth", "above"}) {
      const auto times = results.events.times(name);
      REQUIRE(times.size() == 1);
      if (name != std::string("monitor") && name != std::string("truth"))
        CHECK(times[0] == results.events.times("tick", EventKind::time)[tie.n - 1]);
    }
  }
}

TEST_CASE("3.4 a guard that fired at a tick is not carried across by what its firing sets off",
          "[semantics]") {
  const auto method = GENERATE(from_range(methods));
  for (const Tie& tie : ties()) {
    INFO("method " << method << ", " << words(tie));
    const Results results = run(chained(tie), tie, method);
    for (const char* name : {"reached", "second", "third"})
      CHECK(results.events.times(name).size() == 1);
  }
}
