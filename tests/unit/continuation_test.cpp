// Continuation: two are equal only if every value in them is.
#include "saltus/model/continuation.hpp"

#include <functional>

#include "support/catch.hpp"

using namespace saltus;

namespace {

Continuation some() {
  return {.jump = 3,
          .relations = {1.0, 0.0},
          .guards = {{.side = 1, .from = -1, .error = 0.5, .base = 2.0}},
          .firings = {{.times = {2.0, 1.0}, .after = {4.0}, .holding = true}},
          .edges = {1},
          .counts = {7}};
}

}  // namespace

TEST_CASE("a continuation is equal to a copy and to no other", "[continuation]") {
  CHECK(some() == some());
  CHECK(Continuation{} == Continuation{});
  const std::vector<std::function<void(Continuation&)>> changes{
      [](auto& c) { c.jump = 4; },
      [](auto& c) { c.relations[1] = 1.0; },
      [](auto& c) { c.guards[0].side = -1; },
      [](auto& c) { c.guards[0].from = 1; },
      [](auto& c) { c.guards[0].at_zero = true; },
      [](auto& c) { c.guards[0].resting = true; },
      [](auto& c) { c.guards[0].error = 0.25; },
      [](auto& c) { c.guards[0].base = 0.0; },
      [](auto& c) { c.guards.emplace_back(); },
      [](auto& c) { c.firings[0].times.pop_back(); },
      [](auto& c) { c.firings[0].after[0] = 5.0; },
      [](auto& c) { c.firings[0].states.push_back(1); },
      [](auto& c) { c.firings[0].holding = false; },
      [](auto& c) { c.edges[0] = 0; },
      [](auto& c) { c.counts[0] = 8; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    INFO("change " << i);
    Continuation other = some();
    changes[i](other);
    CHECK(!(other == some()));
  }
}
