// Transition: what reset maps and updates read, what they wrote, and when it becomes the present.
#include "saltus/simulation/detail/transition.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Two leaves with a state and a discrete state each. The derivative of the first one reads both
/// its states and its mode; the second one has a derivative that reads x only.
struct TwoLeaves {
  static Leaf leaf(const char* name, Reads reads) {
    return Leaf(name, [=](Leaf& l) {
      l.declare_continuous_state(
          {.initial = vec({1.0}), .ode = [](const At& at) { return -at.x[0]; }, .reads = reads});
      l.declare_discrete_state(vec({10.0}));
    });
  }
  static Diagram both() {
    DiagramBuilder builder;
    builder.add(std::make_shared<Leaf>(leaf("first", Reads::everything)));
    builder.add(std::make_shared<Leaf>(leaf("second", Reads::continuous_state)));
    return builder.build();
  }

  Diagram diagram = both();
  Machine machine{compile(diagram)};
  Transition transition{machine};

  TwoLeaves() {
    machine.load(diagram.create_context());
    transition.open(), transition.begin_pass();
  }
  bool run(const ResetMap& map, int leaf = 0, Index entry = 0) {
    return transition.run({&map, leaf, entry, 2.0, "block.event"});
  }
};

const ResetMap add_one = [](const At& at, Next& next) {
  next.set_continuous_state({at.x[0] + 1.0});
};
const ResetMap write_double = [](const At& at, Next& next) {
  next.set_continuous_state({2.0 * at.x[0]});
};
const ResetMap write_equal = [](const At& at, Next& next) { next.set_continuous_state({at.x[0]}); };
const ResetMap write_z = [](const At& at, Next& next) { next.set_discrete_state({at.z[0] + 1.0}); };
const ResetMap write_nothing = [](const At&, Next&) {};

}  // namespace

TEST_CASE("two reset maps of one leaf run in their order; each sees what the one before left",
          "[transition]") {
  TwoLeaves one, other;
  one.run(add_one), one.run(write_double);
  other.run(write_double), other.run(add_one);
  CHECK(one.transition.next()[0] == 4.0);
  CHECK(other.transition.next()[0] == 3.0);
  one.run(write_z), one.run(write_z);
  one.transition.commit();
  CHECK(one.machine.z[0] == 12.0);
}

TEST_CASE("a reset map sees the mode that the one before entered", "[transition]") {
  TwoLeaves leaves;
  int seen = -1;
  leaves.transition.enter_mode(0, 3);
  leaves.run([&](const At& at, Next&) { seen = at.mode; });
  CHECK(seen == 3);
}

TEST_CASE("nothing that a pass writes is present before its commit, and all of it is after",
          "[transition]") {
  TwoLeaves leaves;
  leaves.run(add_one, 0), leaves.run(write_z, 0), leaves.run(add_one, 1);
  leaves.transition.enter_mode(1, 2);
  CHECK(leaves.machine.x == vec({1.0, 1.0}));
  CHECK(leaves.machine.z == vec({10.0, 10.0}));
  CHECK(leaves.machine.modes == std::vector{0, 0});
  CHECK(leaves.transition.commit());
  CHECK(leaves.machine.x == vec({2.0, 2.0}));
  CHECK(leaves.machine.z == vec({11.0, 10.0}));
  CHECK(leaves.machine.modes == std::vector{0, 2});
  CHECK(leaves.transition.before() == vec({1.0, 1.0}));
}

TEST_CASE("a reset map writes its own leaf, and reads the entry that fired", "[transition]") {
  TwoLeaves leaves;
  leaves.run([](const At& at,
                Next& next) { next.set_continuous_state({100.0 + static_cast<double>(at.entry)}); },
             1, 7);
  CHECK(leaves.transition.next() == vec({1.0, 107.0}));
}

TEST_CASE("an update sees what an earlier one of its leaf wrote in the pass", "[transition]") {
  TwoLeaves leaves;
  leaves.run(add_one, 0);
  const ResetMap update = [](const At& at, Next& next) { next.set_discrete_state({at.x[0]}); };
  CHECK(leaves.transition.run({&update, 0, 0, 2.0, "block.event"}));
  leaves.transition.commit();
  CHECK(leaves.machine.z[0] == 2.0);
}

TEST_CASE("the next pass begins with the present values", "[transition]") {
  TwoLeaves leaves;
  leaves.run(add_one);
  leaves.transition.commit(), leaves.transition.begin_pass();
  CHECK_FALSE(leaves.transition.pass_wrote());
  CHECK(leaves.transition.writes().of(0) > 0);
  leaves.run(add_one);
  leaves.transition.commit();
  CHECK(leaves.machine.x[0] == 3.0);
  CHECK(leaves.transition.writes().of(0) == 2);
}

TEST_CASE("a reset has an effect on the guards that its block changes, and on no other",
          "[transition]") {
  TwoLeaves leaves;
  leaves.run(add_one, 1), leaves.run(add_one, 1), leaves.run(write_z, 0);
  CHECK(leaves.transition.writes().of(1) == 2);
  CHECK(leaves.transition.writes().of(0) == 0);
  CHECK(leaves.transition.writes().of(GuardGroup{.leaf = 1, .leaves = {0}}) == 0);
  CHECK(leaves.transition.writes().of(GuardGroup{.leaf = 1}) == 0);
  CHECK(leaves.transition.writes().of(GuardGroup{.leaf = 0, .leaves = {0, 1}}) == 2);
  CHECK(leaves.transition.pass_wrote());
  leaves.transition.commit(), leaves.transition.open();
  CHECK(leaves.transition.writes().of(1) == 0);
}

TEST_CASE("writing an equal value is a reset; writing nothing is none", "[transition]") {
  TwoLeaves leaves;
  CHECK_FALSE(leaves.run(write_nothing));
  CHECK_FALSE(leaves.transition.pass_wrote());
  CHECK(leaves.transition.writes().of(0) == 0);
  CHECK(leaves.run(write_equal));
  CHECK(leaves.transition.pass_wrote());
  CHECK(leaves.transition.writes().of(0) == 1);
}

TEST_CASE("the solver restarts where f or x may have changed, and nowhere else", "[transition]") {
  struct Row {
    const char* written;
    const ResetMap* map;
    int leaf, mode;
    bool restarts;
  };
  const auto row =
      GENERATE(values<Row>({{"nothing", &write_nothing, 0, 0, false},
                            {"an equal state", &write_equal, 0, 0, true},
                            {"a discrete state that its derivative reads", &write_z, 0, 0, true},
                            {"a discrete state that no derivative reads", &write_z, 1, 0, false},
                            {"a mode", &write_nothing, 1, 4, true}}));
  INFO(row.written);
  TwoLeaves leaves;
  leaves.run(*row.map, row.leaf);
  leaves.transition.enter_mode(row.leaf, row.mode);
  CHECK(leaves.transition.commit() == (row.mode != 0));
  CHECK(leaves.transition.restarts() == row.restarts);
  leaves.transition.open();
  CHECK_FALSE(leaves.transition.restarts());
}

TEST_CASE(
    "the flow before has the modes before the last change, and the signals before the instant",
    "[transition]") {
  TwoLeaves leaves;
  leaves.transition.open();
  leaves.transition.enter_mode(0, 1), leaves.transition.commit();
  leaves.transition.begin_pass(), leaves.transition.enter_mode(1, 2), leaves.transition.commit();
  leaves.transition.begin_pass();
  CHECK_FALSE(leaves.transition.commit());
  const Eigen::VectorXd before = leaves.machine.y;
  const Eigen::VectorXd now = before.array() + 1.0;
  leaves.machine.y = now;
  leaves.transition.swap_with_before();
  CHECK(leaves.machine.modes == std::vector{1, 0});
  CHECK(leaves.machine.y == before);
  leaves.transition.swap_with_before();
  CHECK(leaves.machine.modes == std::vector{1, 2});
  CHECK(leaves.machine.y == now);
}

TEST_CASE("undo gives back states and modes of before the instant, after any number of passes",
          "[transition]") {
  const int passes = GENERATE(0, 1, 2, 3);
  TwoLeaves leaves;
  for (int pass = 1; pass <= passes; ++pass) {
    leaves.transition.enter_mode(0, pass), leaves.run(add_one), leaves.run(write_z, 1);
    leaves.transition.commit(), leaves.transition.begin_pass();
  }
  leaves.transition.enter_mode(1, 5), leaves.run(write_double);  // this pass does not end
  leaves.transition.undo();
  CHECK(leaves.machine.x == vec({1.0, 1.0}));
  CHECK(leaves.machine.z == vec({10.0, 10.0}));
  CHECK(leaves.machine.modes == List<int>(2, 0));
  leaves.transition.open(), leaves.transition.begin_pass();
  CHECK_FALSE(leaves.transition.commit());  // nothing is left of the mode of that pass
}

TEST_CASE("a mode that a pass leaves and enters again has not changed", "[transition]") {
  TwoLeaves leaves;
  leaves.transition.enter_mode(0, 3), leaves.transition.enter_mode(0, 0);
  CHECK_FALSE(leaves.transition.commit());
}

TEST_CASE("a value has changed if it differs from before the instant, not from before the pass",
          "[transition]") {
  TwoLeaves leaves;
  const Place x{Space::x, 0, 1}, z{Space::z, 0, 1}, p{Space::p, 0, 0};
  leaves.run(add_one), leaves.transition.commit();
  CHECK(leaves.transition.changed(x));
  CHECK_FALSE(leaves.transition.changed(z));
  CHECK_FALSE(leaves.transition.changed(p));
  leaves.transition.begin_pass();
  leaves.run([](const At& at, Next& next) { next.set_continuous_state({at.x[0] - 1.0}); });
  leaves.transition.commit();
  CHECK_FALSE(leaves.transition.changed(x));
}

TEST_CASE("a state that is not finite is refused, with the time and the event", "[transition]") {
  const double value = GENERATE(as<double>{}, infinite, -infinite, not_a_number);
  INFO("value " << value);
  TwoLeaves leaves;
  const auto error = message<SimulationError>(
      [&] { leaves.run([=](const At&, Next& next) { next.set_continuous_state({value}); }, 1); });
  CHECK(error == "t = 2 s: 'block.event' set a state that is not finite (NaN or Inf)");
  CHECK_THROWS_AS(leaves.run([=](const At&, Next& next) { next.set_discrete_state({value}); }, 0),
                  SimulationError);
}
