// RestingStates: an entry rests as long as some hold is on it.
#include "saltus/plan/detail/resting_states.hpp"

#include "saltus/model/diagram_builder.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Leaves of two states and of one.
std::shared_ptr<const Plan> two_leaves() {
  const auto leaf = [](const char* name, Eigen::VectorXd initial) {
    return std::make_shared<Leaf>(name, [&](Leaf& l) {
      l.declare_continuous_state({.initial = std::move(initial),
                                  .ode = [](const At&, VectorRef xdot) { xdot.setOnes(); }});
    });
  };
  DiagramBuilder builder;
  builder.add(leaf("two", vec({0.0, 0.0})));
  builder.add(leaf("one", vec({0.0})));
  return compile(builder.build());
}

}  // namespace

TEST_CASE("an entry moves again when each of its holds has ended", "[resting_states]") {
  const auto plan = two_leaves();
  RestingStates resting(*plan);
  CHECK_FALSE(resting.any());
  resting.rest(1), resting.rest(1);
  CHECK(resting.rests(1));
  CHECK_FALSE(resting.rests(0));
  CHECK(resting.of_leaf(0) == 1);  // an entry, however many holds are on it
  CHECK(resting.of_leaf(1) == 0);
  resting.move(1);
  CHECK(resting.rests(1));
  resting.move(1);
  CHECK_FALSE(resting.rests(1));
  CHECK_FALSE(resting.any());
}

TEST_CASE("entries are counted by leaf, and forgotten together", "[resting_states]") {
  const auto plan = two_leaves();
  RestingStates resting(*plan);
  for (const Index i : {0, 1, 2}) resting.rest(i);
  CHECK(resting.of_leaf(0) == 2);
  CHECK(resting.of_leaf(1) == 1);
  resting.clear();
  CHECK_FALSE(resting.any());
  CHECK(resting.of_leaf(0) == 0);
}
