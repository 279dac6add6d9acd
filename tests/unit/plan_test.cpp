// A plan in words.
#include "saltus/plan/plan.hpp"

#include "support/rates.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("describe counts blocks, states, outputs, guards and time events", "[describe]") {
  const Rates rates;
  const std::string what = compile(*rates.diagram, {{"f", rates.fast->output()}})->describe();
  CHECK(contains(what, "plan: 8 blocks, 0 continuous and 0 discrete states"));
  CHECK(contains(what, "outputs: 8"));
  CHECK(contains(what, "views of a state or parameter, never copied: 1 (one.out)"));
  CHECK(contains(what, "recorded signals: 1"));
  CHECK(contains(what, "time events: 1"));
}
