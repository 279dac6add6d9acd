// Semantics 6.8: times, periods, offsets and counts of any finite size run or are refused.
#include "saltus/library/library.hpp"
#include "saltus/model/context_json.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf ticking(double period, double offset) {
  return {"leaf", [=](Leaf& l) {
            l.declare_discrete_state(vec({0.0}));
            l.declare_periodic_update(count_up, period, offset, "tick");
          }};
}

/// "refused", or "ran" with at most `steps` instants.
std::string outcome(const System& system, double begin, double end, std::int64_t steps = 1000) {
  try {
    simulate(system, system.create_context(begin), {begin, end},
             {.max_major_steps = steps, .throw_errors = false});
    return "ran";
  } catch (const ModelError& error) {
    return contains(error.what(), "cannot be told apart") ? "refused" : error.what();
  }
}

}  // namespace

TEST_CASE("6.8 more ticks before the begin than a double counts are refused", "[semantics]") {
  struct Case {
    double period, offset, begin;
  };
  const auto [period, offset, begin] =
      GENERATE(Case{1.0, -1e300, 0.0}, Case{0.3, 0.0, 0x1p63}, Case{1e-300, -1.0, 0.0},
               Case{1.0, -1e308, 1e308}, Case{5e-324, 0.0, 1.0}, Case{1e-20, 0.0, 1.0},
               Case{1e-3, -1e17, 0.0}, Case{1.0, -1e17, -5e16});
  INFO("period " << period << ", offset " << offset << ", begin " << begin);
  CHECK(outcome(ticking(period, offset), begin, begin + 1.0) == "refused");
}

TEST_CASE("6.8 many ticks before the begin are counted, not walked over", "[semantics]") {
  struct Case {
    double period, offset, begin;
  };
  const auto [period, offset, begin] = GENERATE(
      Case{1.0, -1e12, 0.0}, Case{1e-3, 0.0, 1e9}, Case{0.25, -0x1p46, 0.0}, Case{1.0, 1e300, 0.0},
      Case{1e300, -1e300, 0.0}, Case{1e308, -1e308, 0.0}, Case{1.0, 1e308, -1e308});
  INFO("period " << period << ", offset " << offset << ", begin " << begin);
  CHECK(outcome(ticking(period, offset), begin, begin + 2.0) == "ran");
}

TEST_CASE("6.8 a late time in a context is refused or runs", "[semantics]") {
  const Leaf leaf = ticking(1.0, 0.0);
  const Context late = leaf.create_context(1e300);
  CHECK_THROWS_AS(simulate(leaf, context_from_json(leaf, to_json(late)), {1e300, 2e300}),
                  ModelError);
  const Leaf still("still", [](Leaf& l) { l.declare_one_shot(1.0, {}); });
  CHECK(outcome(still, 1e300, 2e300) == "ran");
}

TEST_CASE("6.8 a clock that reaches its last distinct tick ends with an error that says so",
          "[semantics]") {
  // 4 eps |t| is the period at t = 2^50 periods; the run begins a few ticks before.
  const Leaf leaf = ticking(1.0, 0x1p50 - 8.0);
  const Results results = simulate(leaf, leaf.create_context(0x1p50 - 8.0),
                                   {0x1p50 - 8.0, 0x1p50 + 8.0}, {.throw_errors = false});
  CHECK(results.status == Status::failed);
  CHECK(contains(results.message, "the ticks of 'leaf.tick'"));
  CHECK(contains(results.message, "cannot be told apart"));
}

TEST_CASE("6.8 blocks of the library with late and long times run or are refused", "[semantics]") {
  const double delay = GENERATE(-1e308, -1e17, -1e12, 1e308);
  INFO("phase delay " << delay);
  const Pulse pulse("pulse", {.period = 1.0, .phase_delay = delay});
  CHECK(outcome(pulse, 0.0, 2.0) == (delay < -1e16 ? "refused" : "ran"));
}
