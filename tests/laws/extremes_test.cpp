// The short ones of the extreme cases of docs/stability.md (bench/extremes): each row right, or the
// clear error that it has to be.
#include <algorithm>

#include "extremes/all.hpp"
#include "extremes/run.hpp"
#include "support/catch.hpp"

using namespace extremes;

namespace {

/// A row that is not as it should be yet.
struct Yet {
  std::string_view scene, methods;
};
constexpr Yet not_yet[] = {
    // differences for the Jacobian underflow
    {"x'' = -x, 10 s, amplitude 1e-300", "bdf radau"},
    // the steps of order 1 after a restart are below what time resolves
    {"100 resets 1e-6 s apart (8 roundings of t), from t = 1e9 s", "adams bdf"},
};

bool yet(const Case& c, saltus::Method method) {
  return std::ranges::any_of(not_yet, [&](const Yet& row) {
    return c.name == row.scene && row.methods.find(to_string(method)) != row.methods.npos;
  });
}

/// Runs what is quick; of that, what is known to fail yet, or all else.
void hold(const Group& group, bool failing) {
  for (const Case& c : group.cases) {
    if (!c.quick) continue;
    for (const saltus::Method method : c.methods) {
      if (yet(c, method) != failing) continue;
      const Row row = run(c, method);
      INFO(c.name << ", method " << to_string(method) << ": " << row.happened << ", error "
                  << row.finding.error << ", events " << row.finding.events);
      CHECK(row.verdict != Verdict::wrong);
      if (c.expected == Expected::answer) CHECK(row.verdict == Verdict::right);
    }
  }
}

}  // namespace

TEST_CASE("states of 1e-300 and 1e300 come out right", "[laws][extremes]") {
  hold(sizes_of_states(), false);
}
TEST_CASE("balls over 15 decades come to rest in time", "[laws][extremes]") {
  hold(balls(), false);
}
TEST_CASE("horizons from 1e-12 s to 1e12 s come out right", "[laws][extremes]") {
  hold(horizons(), false);
}
TEST_CASE("tolerances from 1e-2 to 1e-15 are met, tighter ones refused", "[laws][extremes]") {
  hold(tolerances(), false);
}
TEST_CASE("hundreds of guards and thousands of events come out right", "[laws][extremes]") {
  hold(many(), false);
}
TEST_CASE("discontinuities 1e-9 s apart and derivatives of 1e12 come out right",
          "[laws][extremes]") {
  hold(fast(), false);
}
TEST_CASE("where a solution ends there is a clear error", "[laws][extremes]") {
  hold(ends(), false);
}

TEST_CASE("extreme cases that do not come out right yet", "[.engine][laws][extremes]") {
  for (const Group& group : all_groups()) hold(group, true);
}
