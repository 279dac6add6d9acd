// NumberOf: a constant, or a function of the values of a leaf.
#include "saltus/model/number_of.hpp"

#include "saltus/plan/detail/machine.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("a number is itself, and a function is asked with the values of its leaf", "[queue]") {
  const Leaf leaf("leaf", [](Leaf& l) { declare_ramp(l, 1.0, 2.5); });
  Machine machine(compile(leaf));
  machine.load(leaf.create_context());
  const At at = machine.at(0, 3.0, machine.x.data());
  const NumberOf two = 2, half = 0.5;
  const NumberOf sum = [](const At& a) { return a.time + a.x[0]; };
  CHECK((two.is_constant() && half.is_constant() && !sum.is_constant()));
  CHECK(two(leaf, at) == 2.0);
  CHECK(half.constant() == 0.5);
  CHECK(sum(leaf, at) == 5.5);
}
