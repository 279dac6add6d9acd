// UnitDelay, ZeroOrderHold: rates, views and error texts.
#include "library_support.hpp"

using namespace saltus;
using namespace library_test;

TEST_CASE("UnitDelay is held, has no feedthrough and ticks exactly", "[library]") {
  Bench<UnitDelay> delay({Value{5.0, 6.0}}, 0.25, UnitDelay::Options{.initial_state = {1.0, 2.0}});
  CHECK(delay.output() == Numbers{1.0, 2.0});
  CHECK(delay.node().shape == Shape::of(2));
  CHECK(delay.node().rate == Rate::held);
  CHECK(delay.node().needs.empty());
  REQUIRE(delay.plan().schedule.size() == 1);
  CHECK(delay.plan().schedule[0].period == 0.25);
}

TEST_CASE("ZeroOrderHold shows its state, not copied", "[library]") {
  Bench<ZeroOrderHold> hold({7.0}, 0.5, ZeroOrderHold::Options{.initial_state = 3.0});
  CHECK(hold.output() == Numbers{3.0});
  CHECK(hold.node().view);
  CHECK(hold.node().rate == Rate::held);
}

TEST_CASE("a period that is no positive time is refused", "[library]") {
  CHECK(model_error([] { UnitDelay("d", 0.0); }) ==
        "block 'd': dt = 0 s; expected a finite time > 0 s");
  CHECK(contains(model_error([] { ZeroOrderHold("h", -1.0); }), "dt = -1 s"));
}
