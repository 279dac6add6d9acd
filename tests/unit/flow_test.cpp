// Flow: f at the present state is computed once, until the state is written.
#include "saltus/simulation/detail/flow.hpp"

#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A ball at the floor, at t = 1 s.
struct OnFloor {
  Ball ball{{.g = 10.0}};
  SimulatorOptions options{};
  Machine machine{compile(ball)};
  Flow flow{machine, options};
  const GuardGroup& group = machine.plan().guards[0];

  explicit OnFloor(double speed) {
    machine.load(ball.create_context().with_continuous_state(vec({0.0, speed})));
    flow.open(1.0, 10.0);
  }
  template <class Ask>
  auto calls(Ask ask) {
    const auto before = machine.rhs_calls;
    ask();
    return machine.rhs_calls - before;
  }
};

}  // namespace

TEST_CASE("nothing is known before the first question, nor after a write", "[flow]") {
  OnFloor floor(0.0);
  CHECK(floor.flow.known() == nullptr);
  floor.flow.side(floor.group, 0, 0.0, 0);
  REQUIRE(floor.flow.known() != nullptr);
  CHECK(*floor.flow.known() == vec({0.0, -10.0}));
  floor.flow.forget();
  CHECK(floor.flow.known() == nullptr);
  floor.flow.rounding(0);
  floor.flow.open(2.0, 10.0);
  CHECK(floor.flow.known() == nullptr);
}

TEST_CASE("f at the present state is computed once for all questions", "[flow]") {
  OnFloor floor(1.0);
  const auto slope = [&] { floor.flow.slope(floor.group, 0); };
  const auto first = floor.calls(slope), second = floor.calls(slope);
  CHECK(second < first);
  floor.flow.forget();
  CHECK(floor.calls(slope) == first);
}

TEST_CASE("after a write the side is that of the new state", "[flow]") {
  OnFloor floor(1.0);
  CHECK(floor.flow.side(floor.group, 0, 0.0, 0).side == 1);
  floor.machine.x[1] = -1.0;
  floor.flow.forget();
  CHECK(floor.flow.side(floor.group, 0, 0.0, 0).side == -1);
}

TEST_CASE("a question about another state leaves the present one to be asked again", "[flow]") {
  OnFloor floor(1.0);
  floor.flow.slope(floor.group, 0);
  CHECK(floor.flow.slope_from(vec({0.0, -3.0}), floor.group, 0) < 0.0);
  CHECK(floor.flow.known() == nullptr);
  CHECK(floor.flow.slope(floor.group, 0) > 0.0);
}

TEST_CASE("a flow leads back unless the guard was merely passed through", "[flow]") {
  // The guard fired coming from above; `before` and `after` are the speeds around its reset.
  struct Row {
    const char* what;
    double before, after;
    bool back;
  };
  const auto row =
      GENERATE(values<Row>({{"a ball that was stopped", -3.0, 0.0, true},
                            {"a ball that goes on as fast", -3.0, -3.0, false},
                            {"a ball that goes on half as fast", -3.0, -1.5, false},
                            {"a ball that a kick from rest sends into the floor", 0.0, -1.0, true},
                            {"a ball that goes off the floor", -3.0, 2.0, true}}));
  INFO(row.what);
  OnFloor floor(row.after);
  CHECK(floor.flow.leads_back(floor.group, 0, 1, vec({0.0, row.before})) == row.back);
}

TEST_CASE("a question about a short time looks no further than that time", "[flow]") {
  // y = -5 + 10 t - 5 t^2 rises to the floor, and is 10 m below it again after 1 + sqrt(2) s.
  OnFloor floor(10.0);
  floor.machine.x[0] = -5.0;
  CHECK(floor.flow.side_within(2.0, floor.group, 0, 10.0, 0).side == 0);
  CHECK(floor.flow.side_within(30.0, floor.group, 0, 10.0, 0).side == -1);
}

TEST_CASE("an opaque guard, which is only a sign, has no tolerance", "[flow]") {
  OnFloor floor(1.0);
  CHECK(floor.flow.tolerance(0, true) == 0.0);
  CHECK(floor.flow.tolerance(0, false) > 0.0);
}
