// The decisions of the queue, row by row of their tables.
#include "saltus/simulation/detail/queue_decisions.hpp"

#include <stdexcept>
#include <vector>

#include "support/catch.hpp"
#include "support/run.hpp"

using namespace saltus;

namespace {

constexpr auto falls = Direction::positive_then_non_positive;
constexpr auto rises = Direction::negative_then_non_negative;

double no_draw() { throw std::logic_error("drew without a tie"); }

std::size_t first_of(const std::vector<double>& priorities, double draw) {
  return choose_first(priorities, [&] { return draw; });
}

}  // namespace

TEST_CASE("a trigger schedules from its armed side, and cancels from its firing side", "[queue]") {
  struct Row {
    Direction declared;
    int from;
    OnTrigger then;
  };
  for (const Row& row : {Row{falls, +1, OnTrigger::schedule}, Row{falls, -1, OnTrigger::cancel},
                         Row{rises, -1, OnTrigger::schedule}, Row{rises, +1, OnTrigger::cancel},
                         Row{Direction::crosses_zero, +1, OnTrigger::schedule},
                         Row{Direction::crosses_zero, -1, OnTrigger::schedule},
                         Row{Direction::edge_detection, +1, OnTrigger::schedule},
                         Row{Direction::edge_detection, -1, OnTrigger::schedule}}) {
    INFO(to_string(row.declared) << " from " << row.from);
    CHECK(decide_trigger(row.declared, row.from) == row.then);
  }
}

TEST_CASE("a delay is a finite number that is not negative", "[queue]") {
  CHECK(is_delay(0.0));
  CHECK(is_delay(1e-300));
  for (const double bad : {-1e-300, -1.0, support::infinite, support::not_a_number})
    CHECK_FALSE(is_delay(bad));
}

TEST_CASE("the highest priority comes first, and nothing is drawn", "[queue]") {
  CHECK(choose_first(std::vector{1.0}, no_draw) == 0);
  CHECK(choose_first(std::vector{1.0, 3.0, 2.0}, no_draw) == 1);
  CHECK(choose_first(std::vector{no_priority, -1e300}, no_draw) == 1);
  CHECK(choose_first(std::vector{2.0, 2.0, 3.0}, no_draw) == 2);
  CHECK(choose_first(std::vector{1.0, support::infinite}, no_draw) == 1);
}

TEST_CASE("of equal priorities the draw decides, each with its share", "[queue]") {
  const std::vector three{5.0, 1.0, 5.0, 5.0};
  CHECK(first_of(three, 0.1) == 0);
  CHECK(first_of(three, 0.34) == 2);
  CHECK(first_of(three, 0.66) == 2);
  CHECK(first_of(three, 0.67) == 3);
  CHECK(first_of(three, 1.0 - 0x1p-53) == 3);
  CHECK(first_of({no_priority, no_priority}, 0.4) == 0);
  CHECK(first_of({no_priority, no_priority}, 0.6) == 1);
}

TEST_CASE("a chain grows by what its last execution set off, others stand beside it", "[queue]") {
  ExecutionChain chain;
  CHECK(chain.next() == 1);
  for (int pass = 0; pass < 3; ++pass) chain.execute(1, pass);  // three that were due anyway
  CHECK(chain.beside() == 2);
  CHECK(chain.next() == 2);
  chain.execute(2, 3), chain.execute(3, 4);
  CHECK(chain.beside() == 2);  // the chain has three of the five
  CHECK(chain.next() == 4);
}

TEST_CASE("passes that an execution sets off count until the next execution", "[queue]") {
  ExecutionChain chain;
  chain.execute(1, 0);
  chain.trigger(2), chain.trigger(2);  // pass 1 is one of reset maps, pass 2 one of triggers
  CHECK(3 - chain.beside() == 2);      // three passes: the execution and the reset maps count
  chain.execute(1, 3);
  CHECK(4 - chain.beside() == 1);  // another execution, which was due anyway
  CHECK(9 - chain.beside() == 6);  // five passes of reset maps after it
}
