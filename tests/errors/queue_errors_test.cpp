// What a queued zero crossing cannot be: each is refused where it is declared, with what to do.
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

constexpr auto rises = Direction::negative_then_non_negative;

std::string refusal(ZeroCrossing crossing) {
  return message<ModelError>([&] {
    const Leaf leaf("leaf", [&](Leaf& l) {
      declare_ramp(l);
      crossing.name = "e";
      crossing.guard = [](const At& at) { return at.x[0]; };
      l.declare_zero_crossing(crossing);
    });
  });
}

const ResetMap nothing = [](const At&, Next&) {};

}  // namespace

TEST_CASE("a queued zero crossing is neither terminal nor a monitor", "[errors][queue]") {
  CHECK(contains(refusal({.reset_map = nothing, .terminal = true, .delay = 1.0}),
                 "block 'leaf': zero crossing 'e' is queued and terminal; expected one of them"));
  CHECK(contains(refusal({.delay = 1.0}), "is queued and has neither a reset map nor an end_mode"));
  CHECK(refusal({.end_mode = 2, .delay = 1.0}) == "no exception");
}

TEST_CASE("a queued zero crossing has no Zeno hold", "[errors][queue]") {
  for (const std::string& found :
       {refusal({.reset_map = nothing, .on_zeno = OnZeno::stop(), .delay = 1.0}),
        refusal({.reset_map = nothing, .zeno_tolerance = 1e-3, .delay = 1.0}),
        refusal({.reset_map = nothing, .holds = {{0}}, .delay = 1.0})})
    CHECK(contains(found, "is queued, so it has no Zeno monitor"));
}

TEST_CASE("constant delays and priorities are numbers that make sense", "[errors][queue]") {
  CHECK(contains(refusal({.reset_map = nothing, .delay = -0.5}),
                 "has a delay of -0.5 s; expected a finite time >= 0 s"));
  CHECK(contains(refusal({.reset_map = nothing, .delay = infinite}), "has a delay of inf s"));
  CHECK(contains(refusal({.reset_map = nothing, .priority = not_a_number}),
                 "has a priority that is not a number"));
}

TEST_CASE("a trigger that goes back, or was true before the start, has one direction",
          "[errors][queue]") {
  CHECK(contains(refusal({.reset_map = nothing, .persistent = false}),
                 "is not persistent, and its direction is crosses_zero: it has no firing side"));
  CHECK(contains(
      refusal(
          {.reset_map = nothing, .direction = Direction::edge_detection, .initial_value = true}),
      "has an initial_value, and its direction is edge_detection"));
  CHECK(refusal({.reset_map = nothing, .direction = rises, .persistent = false}) == "no exception");
  CHECK(contains(refusal({.reset_map = nothing,
                          .direction = rises,
                          .at_start = AtStart::fire,
                          .initial_value = true}),
                 "has an initial_value and an at_start; expected one of them"));
}

TEST_CASE("values of the trigger time are those of a reset map", "[errors][queue]") {
  CHECK(contains(refusal({.end_mode = 1, .use_values_from_trigger_time = true}),
                 "uses values from its trigger time and has no reset map"));
}
