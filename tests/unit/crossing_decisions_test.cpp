// The decisions about zero crossings, row by row of their tables. No run, no machine: values only.
#include "saltus/simulation/detail/crossing_decisions.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr auto falls = Direction::positive_then_non_positive;
constexpr auto rises = Direction::negative_then_non_negative;
constexpr auto either = Direction::crosses_zero;
constexpr auto edge = Direction::edge_detection;
constexpr double eps = 1e-12;  // an error bound for the rows

/// What a row says of the flow. Asking for anything else fails the test: it costs right-hand sides.
struct Answers {
  std::optional<double> slope_ = {};
  std::optional<bool> low = {}, back = {}, turns = {}, round = {}, stops = {}, still = {},
                      sure = {}, struck = {}, together = false;

  template <class T>
  static T said(const std::optional<T>& answer, const char* what) {
    if (!answer) throw std::logic_error(std::string("asked for ") + what);
    return *answer;
  }
  double slope() const { return said(slope_, "the slope"); }
  bool too_low() const { return said(low, "the height of the flight"); }
  bool leads_back() const { return said(back, "the flow before"); }
  bool stops_at_jump() const { return said(stops, "the distance from the jump"); }
  bool reset_turns(int) const { return said(turns, "another reset"); }
  bool turned_round(int) const { return said(round, "the flow of the mode before"); }
  bool stood_still() const { return said(still, "the flow before"); }
  bool is_struck() const { return said(struck, "the slopes before and after a reset"); }
  bool moves_together() const { return said(together, "whether its states move together"); }
  bool is_slope_sure() const { return said(sure, "whether the slope is sure"); }
};

const Arming waits_at(int side) { return {.phase = Phase::waiting, .side = side}; }
const Arming fires_from(int from, int side) {
  return {.phase = Phase::waiting, .side = side, .then = Arming::Then::fire, .from = from};
}
const Arming within_tolerance(int side) {
  return {.phase = Phase::waiting, .side = side, .within = Arming::Within::tolerance};
}
const Arming rests_at(int side) {
  return {.phase = Phase::waiting, .side = side, .then = Arming::Then::rest};
}

struct Row {
  std::string name;
  CrossingFacts guard;
  FlowSide flow;
  Answers flow_says;
  Arming expected;
};

/// The same row upside down: the law knows neither up nor down for a guard with a direction.
Row mirrored(Row row) {
  row.name += ", upside down";
  row.guard.direction = row.guard.direction == falls ? rises : falls;
  row.guard.side = -row.guard.side, row.guard.g = -row.guard.g;
  row.guard.came_from = -row.guard.came_from, row.flow.side = -row.flow.side;
  if (row.flow_says.slope_) row.flow_says.slope_ = -*row.flow_says.slope_;
  row.expected.side = -row.expected.side, row.expected.from = -row.expected.from;
  return row;
}

void check_one(const Row& row) {
  INFO(row.name);
  CHECK(decide_crossing(row.guard, row.flow, row.flow_says) == row.expected);
}

void check(const std::vector<Row>& table) {
  for (const Row& row : table) {
    check_one(row);
    if (row.guard.direction == falls) check_one(mirrored(row));
  }
}

}  // namespace

TEST_CASE("A guard that begins at zero or beyond does what its author said") {
  struct Begins {
    AtStart wish;
    Direction direction;
    double g;
    Beginning expected;
  };
  const auto automatic = AtStart::automatic, error = AtStart::error, fire = AtStart::fire,
             ignore = AtStart::ignore;
  const std::vector<Begins> table = {
      {automatic, falls, 1.0, Beginning::by_flow},  {automatic, falls, 0.0, Beginning::by_flow},
      {automatic, falls, -1.0, Beginning::by_flow}, {error, falls, 1.0, Beginning::by_flow},
      {error, falls, 0.0, Beginning::refuse},       {error, falls, -1.0, Beginning::refuse},
      {error, rises, 1.0, Beginning::refuse},       {error, rises, -1.0, Beginning::by_flow},
      {fire, falls, 1.0, Beginning::by_flow},       {fire, falls, 0.0, Beginning::fire},
      {fire, falls, -1.0, Beginning::fire},         {ignore, falls, 1.0, Beginning::by_flow},
      {ignore, falls, 0.0, Beginning::wait},        {ignore, falls, -1.0, Beginning::by_flow},
      {fire, either, -1.0, Beginning::by_flow},     {fire, either, 0.0, Beginning::fire},
      {fire, edge, 0.0, Beginning::by_flow},        {error, edge, 0.0, Beginning::by_flow}};
  for (const Begins& row : table) {
    INFO(static_cast<int>(row.wish) << " " << to_string(row.direction) << " " << row.g);
    CHECK(decide_beginning(row.wish, row.direction, row.g) == row.expected);
  }
}

TEST_CASE("The flow is asked about guards at zero, and about no others") {
  const auto unasked = []() -> double { throw std::logic_error("asked for the uncertainty"); };
  const auto wide = [] { return 1e-9; };
  const CrossingFacts off{.g = 1.0}, at{.g = 0.0}, fired{.g = 1.0, .fired = true};
  CHECK_FALSE(needs_flow(off, unasked));
  CHECK(needs_flow(at, unasked));
  CHECK(needs_flow(fired, unasked));
  CHECK(needs_flow({.g = 1e-17, .put_at_zero = true}, unasked));
  CHECK_FALSE(needs_flow({.direction = edge, .g = 0.0, .fired = true}, unasked));
  CrossingFacts waits{.phase = Phase::waiting, .g = 1e-13, .error = eps};
  CHECK_FALSE(needs_flow(waits, unasked));  // dormant as before
  waits.resets = 1;
  CHECK(needs_flow(waits, unasked));  // a reset wrote: look again
  waits.g = 1e-3;
  CHECK_FALSE(needs_flow(waits, unasked));
  CHECK(needs_flow({.g = 1e-10, .entered = true}, wide));
  CHECK_FALSE(needs_flow({.g = 1e-8, .entered = true}, wide));
  // Struck by a reset, a rounding beyond zero.
  CrossingFacts beyond{.direction = falls, .side = -1, .g = -1e-10, .effect = true, .resets = 1};
  CHECK(needs_flow(beyond, wide));
  beyond.g = -1e-8;
  CHECK_FALSE(needs_flow(beyond, wide));
  beyond.g = -1e-10, beyond.resets = 0;
  CHECK_FALSE(needs_flow(beyond, unasked));
  beyond.resets = 1, beyond.effect = false;
  CHECK_FALSE(needs_flow(beyond, unasked));
  // An armed guard has an error until the next look, where it fires by decision: it is not at zero.
  CHECK_FALSE(needs_flow({.side = 1, .g = 1e-13, .error = eps, .resets = 1}, unasked));
}

TEST_CASE("A guard at zero that has not fired: contact, dormant, or waiting") {
  const CrossingFacts bounce{
      .direction = falls, .phase = Phase::armed, .side = 1, .effect = true, .reset = true};
  const auto with = [&](auto change) {
    CrossingFacts facts = bounce;
    change(facts);
    return facts;
  };
  const CrossingFacts starts = with([](auto& f) { f.at_start = true; });
  const CrossingFacts turned = with([](auto& f) { f.resets = 1; });
  const CrossingFacts monitor =
      with([](auto& f) { f.effect = f.reset = false, f.at_start = true; });
  const CrossingFacts both = with([](auto& f) { f.direction = either, f.at_start = true; });
  const CrossingFacts both_turned = with([](auto& f) { f.direction = either, f.resets = 1; });
  CrossingFacts both_passed = both_turned;
  both_passed.phase = Phase::waiting;
  check({
      {"begins at zero, headed down: contact", starts, {-1, eps}, {}, fires_from(1, -1)},
      {"begins at zero, headed up: it flies", starts, {1, eps}, {}, waits_at(1)},
      {"begins at zero and stays: dormant, armed above", starts, {0, eps}, {}, waits_at(1)},
      {"a monitor that begins at zero waits", monitor, {-1, eps}, {}, waits_at(-1)},
      {"a dormant monitor has no side", monitor, {0, eps}, {}, waits_at(0)},
      {"a reset of another guard turned the flow round", turned, {-1, eps}, {}, fires_from(1, -1)},
      {"a reset of another guard sent it off", turned, {1, eps}, {}, waits_at(1)},
      {"neither begins nor turned: it waits", bounce, {-1, eps}, {}, waits_at(-1)},
      {"either direction, slope zero, is in contact",
       both,
       {-1, eps},
       {.slope_ = 0.0},
       fires_from(1, -1)},
      {"either direction, passing through, is not",
       both,
       {-1, eps},
       {.slope_ = -1.0},
       waits_at(-1)},
      {"either direction, sent across by a reset", both_turned, {-1, eps}, {}, fires_from(1, -1)},
      {"either direction, sent back by a reset", both_turned, {1, eps}, {}, waits_at(1)},
      {"either direction, passed through, its own reset sends it back",
       both_passed,
       {-1, eps},
       {.turns = true},
       fires_from(1, -1)},
      {"either direction, passed through, its own reset does not",
       both_passed,
       {-1, eps},
       {.turns = false},
       waits_at(-1)},
      {"either direction, passed through, and it has no reset map",
       with([&](auto& f) { f = both_passed, f.reset = false; }),
       {-1, eps},
       {},
       waits_at(-1)},
      {"of one direction it has not passed through where it waits",
       with([](auto& f) { f.resets = 1, f.phase = Phase::waiting; }),
       {-1, eps},
       {},
       fires_from(1, -1)},
      {"on its firing side already, and the reset sent it on: no contact",
       with([](auto& f) { f.resets = 1, f.side = -1; }),
       {-1, eps},
       {.struck = false},
       waits_at(-1)},
      {"on its firing side already, and struck by the reset: contact",
       with([](auto& f) { f.resets = 1, f.side = -1; }),
       {-1, eps},
       {.struck = true},
       fires_from(1, -1)},
      {"on its firing side already, and the flow leads off: no contact",
       with([](auto& f) { f.resets = 1, f.side = -1; }),
       {1, eps},
       {},
       waits_at(1)},
      {"dormant on its firing side: no side",
       with([](auto& f) { f.side = -1; }),
       {0, eps},
       {},
       waits_at(0)},
      {"at the start it has no side yet, and is in contact all the same",
       with([](auto& f) { f.at_start = true, f.side = 0, f.phase = Phase::unseen; }),
       {-1, eps},
       {},
       fires_from(1, -1)},
      {"dormant, of either direction: its side",
       with([](auto& f) { f.direction = either; }),
       {0, eps},
       {},
       waits_at(1)},
      {"a commit moved it to zero, and the flow takes it on: it has arrived",
       with([](auto& f) { f.put_at_zero = true; }),
       {-1, eps},
       {},
       fires_from(1, -1)},
      {"a commit moved it to zero, and it stays there: it has arrived",
       with([](auto& f) { f.put_at_zero = true; }),
       {0, eps},
       {},
       fires_from(1, 1)},
      {"a commit moved it to zero, and the flow takes it back: a wrap does not ring",
       with([](auto& f) { f.put_at_zero = true, f.resets = 1; }),
       {1, eps},
       {},
       waits_at(1)},
      {"a terminal guard without an effect arrives too",
       with([](auto& f) { f.put_at_zero = true, f.effect = f.reset = false; }),
       {0, eps},
       {},
       fires_from(1, 0)},
      {"of either direction, moved to zero from below, taken on",
       with([](auto& f) { f.direction = either, f.side = -1, f.put_at_zero = true; }),
       {1, eps},
       {},
       fires_from(-1, 1)},
      {"of either direction, moved to zero from below, taken back",
       with([](auto& f) { f.direction = either, f.side = -1, f.put_at_zero = true; }),
       {-1, eps},
       {},
       waits_at(-1)},
  });
}

TEST_CASE("A guard that fired: off, back, at rest, or passed through") {
  const CrossingFacts bounce{.direction = falls,
                             .phase = Phase::armed,
                             .side = 1,
                             .g = 0.0,
                             .fired = true,
                             .came_from = 1,
                             .effect = true,
                             .reset = true,
                             .resets = 1};
  const auto with = [&](auto change) {
    CrossingFacts facts = bounce;
    change(facts);
    return facts;
  };
  const CrossingFacts plain = with([](auto& f) { f.reset = f.effect = false, f.resets = 0; });
  const CrossingFacts silent = with([](auto& f) { f.resets = 0; });
  const CrossingFacts two = with([](auto& f) { f.resets = 2; });
  check({
      {"the flow leads off", bounce, {1, eps}, {.low = false}, waits_at(1)},
      {"the flow leads straight back: at rest",
       bounce,
       {-1, eps},
       {.low = false, .back = true},
       rests_at(1)},
      {"the flow leads straight back, and what would rest moves together: go on",
       bounce,
       {-1, eps},
       {.low = false, .back = true, .together = true},
       waits_at(1)},
      {"it was merely passed through",
       bounce,
       {-1, eps},
       {.low = false, .back = false},
       waits_at(-1)},
      {"the flight was too low to see: at rest", bounce, {1, eps}, {.low = true}, rests_at(1)},
      {"clearly above, headed up: armed at once",
       with([](auto& f) { f.g = 1.0; }),
       {1, eps},
       {},
       {.phase = Phase::armed, .side = 1}},
      {"clearly above, headed down: armed, about to cross",
       with([](auto& f) { f.g = 1.0; }),
       {-1, eps},
       {},
       {.phase = Phase::armed, .side = 1}},
      {"beyond its error, headed down: no rest",
       with([](auto& f) { f.g = -1.0; }),
       {-1, eps},
       {.low = false},
       waits_at(-1)},
      {"jumped, at its jump and left from rest: at rest",
       with([](auto& f) { f.g = -1.0, f.jumped = true; }),
       {-1, eps},
       {.low = false, .back = true, .stops = true},
       rests_at(1)},
      {"jumped, and beyond its jump or passed through: no rest",
       with([](auto& f) { f.g = -1.0, f.jumped = true; }),
       {-1, eps},
       {.low = false, .stops = false},
       waits_at(-1)},
      {"another reset sent it back, its own turns it: again",
       two,
       {-1, eps},
       {.low = false, .turns = true},
       fires_from(1, -1)},
      {"another reset sent it back, its own does not",
       two,
       {-1, eps},
       {.low = false, .back = true, .turns = false},
       rests_at(1)},
      {"stays at zero after a reset that wrote: armed above",
       bounce,
       {0, eps},
       {.low = false},
       waits_at(1)},
      {"stays at zero, nothing written: no side", silent, {0, eps}, {.low = false}, waits_at(0)},
      {"too low a flight, another reset sent it back: again",
       two,
       {1, eps},
       {.low = true, .turns = true},
       fires_from(1, 1)},
      {"too low a flight, and the flow keeps it at zero: at rest",
       bounce,
       {0, eps},
       {.low = true},
       rests_at(1)},
      {"too low a flight, but beyond its error: no rest",
       with([](auto& f) { f.g = -1.0; }),
       {0, eps},
       {.low = true},
       waits_at(1)},
      {"without a reset map it follows the flow", plain, {-1, eps}, {}, waits_at(-1)},
      {"without a reset map it never rests", plain, {0, eps}, {}, waits_at(0)},
      {"without a reset map it has no side at zero, though another reset wrote",
       with([](auto& f) { f.reset = false; }),
       {0, eps},
       {},
       waits_at(0)},
      {"without a reset map, clearly above: it waits on the flow's side too",
       with([](auto& f) { f.reset = f.effect = false, f.resets = 0, f.g = 1.0; }),
       {1, eps},
       {},
       waits_at(1)},
  });
}

TEST_CASE("A guard whose mode was entered at its zero") {
  const CrossingFacts entered{
      .direction = falls, .phase = Phase::unseen, .entered = true, .effect = true};
  CrossingFacts monitor = entered, both = entered;
  monitor.effect = false, both.direction = either;
  const Arming slides{.then = Arming::Then::fire, .from = 1};
  check({
      {"both modes lead to the surface: it fires",
       entered,
       {-1, eps},
       {.slope_ = -1.0, .round = true},
       slides},
      {"only this one does: it waits",
       entered,
       {-1, eps},
       {.slope_ = -1.0, .round = false, .still = false},
       waits_at(-1)},
      {"nothing moved before: it begins in contact and fires",
       entered,
       {-1, eps},
       {.slope_ = -1.0, .round = false, .still = true},
       fires_from(1, -1)},
      {"a hop lower than the tolerance: the slope decides",
       entered,
       {-1, eps},
       {.slope_ = 1.0, .sure = true},
       waits_at(1)},
      {"a slope that may be rounding decides nothing",
       entered,
       {-1, eps},
       {.slope_ = 1.0, .round = false, .still = false, .sure = false},
       waits_at(-1)},
      {"headed off the surface", entered, {1, eps}, {.slope_ = 1.0}, waits_at(1)},
      {"leaves along the surface: at zero within the tolerance",
       entered,
       {1, eps},
       {.slope_ = 0.0},
       within_tolerance(1)},
      {"leaves along the surface, not seen by rounding",
       entered,
       {0, eps},
       {.slope_ = 0.0},
       within_tolerance(1)},
      {"fired since its mode was entered: decided as one that fired",
       [&] {
         CrossingFacts f = entered;
         f.fired = true, f.came_from = 1;
         return f;
       }(),
       {-1, eps},
       {},
       waits_at(-1)},
      {"a monitor does not slide", monitor, {-1, eps}, {.slope_ = -1.0}, waits_at(-1)},
      {"a monitor leaves along the surface: at zero within its rounding",
       monitor,
       {1, eps},
       {.slope_ = 0.0},
       waits_at(1)},
      {"of either direction, both modes lead to the surface from above",
       both,
       {-1, eps},
       {.slope_ = -1.0, .round = true},
       slides},
      {"of either direction, both modes lead to the surface from below",
       both,
       {1, eps},
       {.slope_ = 1.0, .round = true},
       {.then = Arming::Then::fire, .from = -1}},
  });
}

TEST_CASE("A slope is passed through with if it went the same way before, and was not stopped") {
  CHECK(passed_through(1.0, 1.0));
  CHECK(passed_through(2e-6, 1.0));
  CHECK_FALSE(passed_through(1e-7, 1.0));
  CHECK_FALSE(passed_through(1.0, 0.0));
  CHECK_FALSE(passed_through(1.0, -1.0));
}

TEST_CASE("A reset strikes bodies in contact where nearly all of their slope is new") {
  CHECK(is_struck(1.0, 0.0));
  CHECK(is_struck(1.0, 9e-4));
  CHECK(is_struck(1.0, -9e-4));
  CHECK_FALSE(is_struck(1.0, 2e-3));
  CHECK_FALSE(is_struck(1.0, -2e-3));
  CHECK_FALSE(is_struck(0.0, -1.0));
  CHECK_FALSE(is_struck(-1.0, 0.0));
}

TEST_CASE("A root is false if the flow still leaves zero, or if nothing shows that it has left") {
  for (const int from : {1, -1}) {
    CHECK(is_false_root(from, -from * 2.0 * eps, {from, eps}));
    CHECK_FALSE(is_false_root(from, 0.0, {-from, eps}));
    CHECK(is_false_root(from, -from * eps, {0, eps}));
    CHECK(is_false_root(from, 0.0, {0, 0.0}));
    CHECK_FALSE(is_false_root(from, -from * 2.0 * eps, {0, eps}));
  }
}
