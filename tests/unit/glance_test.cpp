// Glance: which steps need no look inside, by how fast the guards moved recently.
#include "saltus/solver/detail/glance.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A guard that varies as the state does, or a function of which nothing is known.
ZeroCrossing guard(bool called) {
  if (called) return {.name = "g", .guard = [](const At& at) { return at.x[0]; }};
  return {.name = "g", .formula = [](const auto& at) { return at.x(0); }};
}

struct Parts {
  explicit Parts(bool called)
      : leaf("leaf",
             [=](Leaf& l) { declare_ramp(l), l.declare_zero_crossing(guard(called)); }),
        machine(compile(leaf)),
        guards(machine.plan()) {
    machine.load(leaf.create_context());
    guards.select(machine.seen_guards().groups(), machine.plan());
  }
  Leaf leaf;
  Machine machine;
  GuardSet guards;
};

/// Steps of one second, in which the test moves a guard.
class Steps : private Parts, private Glance {
 public:
  explicit Steps(double begin, bool called = false)
      : Parts(called), Glance(Parts::machine, Parts::guards, Parts::guards.active().monitors) {
    scan_points_ = 4;
    guards_->arm(0, 1);
    guards_->g[0] = begin;
    look_up_guards();
  }
  /// Whether the next step, to this value, needs no look inside. The step is taken.
  bool needs_no_look(double value) {
    high_[0] = value;
    const bool none = out_of_reach(1.0);
    shift_all(-1.0, 0.0);
    return none;
  }
};

/// How many steps without a movement a guard at `distance` needs until no look is needed, after one
/// in which it moved by 1.
int steps_until_out_of_reach(double distance) {
  Steps steps(distance + 1.0);
  steps.needs_no_look(distance);
  int count = 0;
  while (count < 100 && !steps.needs_no_look(distance)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a guard that could be at zero and back at twice its recent speed needs a look",
          "[glance]") {
  CHECK_FALSE(Steps(2.0).needs_no_look(1.0));
  CHECK_FALSE(Steps(1.0).needs_no_look(0.4));
  CHECK(Steps(1000.0).needs_no_look(999.0));
  CHECK_FALSE(Steps(1.0).needs_no_look(-1.0));
  CHECK_FALSE(Steps(1.0).needs_no_look(NAN));
}

TEST_CASE("a guard that has moved fast is watched for some more steps", "[glance]") {
  // The speed of 1 is halved with each step: at a distance of 1 it is out of reach at a quarter.
  CHECK(steps_until_out_of_reach(1.0) >= 2);
  CHECK(steps_until_out_of_reach(1.0) <= 5);
  CHECK(steps_until_out_of_reach(100.0) == 0);
}

TEST_CASE("a called guard that had one value at both ends of a step needs a look", "[glance]") {
  Steps steps(1000.0, true);
  CHECK(steps.needs_no_look(999.0));
  CHECK_FALSE(steps.needs_no_look(999.0));
  CHECK(steps.needs_no_look(998.0));
}
