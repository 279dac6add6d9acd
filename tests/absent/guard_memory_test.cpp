// A guard of many entries asks for memory in proportion to them.
#include "saltus/simulation/simulator.hpp"
#include "support/allocations.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// n states and one guard of n entries, each with a reset map.
Leaf leaf_with(Index n) {
  return Leaf("leaf", [n](Leaf& l) {
    l.declare_continuous_state({.initial = Eigen::VectorXd::Zero(n),
                                .ode = [](const At&, VectorRef xdot) { xdot.setOnes(); }});
    l.declare_zero_crossing(
        {.name = "level",
         .guard = [](const At& at, VectorRef g) { g = at.x.array() - 1.0; },
         .reset_map = [](const At& at,
                         Next& next) { next.set_continuous_state(Eigen::VectorXd(-at.x)); },
         .size = n});
  });
}

/// Bytes asked for until a run can begin.
long planning(Index n) {
  const Leaf leaf = leaf_with(n);
  const Context context = leaf.create_context();
  const long before = allocated_bytes();
  Simulator simulator(leaf, {});
  simulator.initialize(context);
  return allocated_bytes() - before;
}

}  // namespace

/// Each entry kept a list of its own of all the states that rest with it: n^2 numbers.
TEST_CASE("the plan of a vector guard grows with its entries, not with their square", "[absent]") {
  if (allocated_bytes() < 0) return;  // cannot be counted here
  const long once = planning(1000), twice = planning(2000);
  INFO(once << " and " << twice << " bytes");
  CHECK(twice < 3 * once);       // n^2 would be four times as much
  CHECK(twice < 2000L * 2000L);  // a byte for each pair of an entry and a state
}
