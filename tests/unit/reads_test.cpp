// Reads: a set of what a value depends on.
#include "saltus/base/reads.hpp"

#include "support/catch.hpp"

using namespace saltus;

namespace {

constexpr Reads single[] = {Reads::time,    Reads::continuous_state, Reads::discrete_state,
                            Reads::mode,    Reads::inputs,           Reads::relations,
                            Reads::schedule};

}  // namespace

TEST_CASE("each thing to read is in a set of it and in no set of another", "[reads]") {
  for (const Reads one : single) {
    for (const Reads other : single) CHECK(has(one, other) == (one == other));
    CHECK(!has(Reads::parameters, one));
  }
}

TEST_CASE("a union has what either has", "[reads]") {
  const Reads both = Reads::time | Reads::inputs;
  for (const Reads one : single)
    CHECK(has(both, one) == (one == Reads::time || one == Reads::inputs));
  CHECK((Reads::parameters | Reads::mode) == Reads::mode);
}

TEST_CASE("everything is all but the schedule: the time is in it already", "[reads]") {
  for (const Reads one : single) CHECK(has(Reads::everything, one) == (one != Reads::schedule));
}
