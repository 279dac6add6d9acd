// Identities: every system has one of its own; an index of a parameter is where it begins.
#include "saltus/base/ids.hpp"

#include <unordered_set>

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

TEST_CASE("every system that is made has another id, copies of ids are equal", "[ids]") {
  std::unordered_set<SystemId> seen;
  SystemId last;
  for (int i = 0; i < 20; ++i) {
    const Leaf leaf("leaf", [](Leaf&) {});
    const SystemId id = leaf.system_id();
    CHECK(seen.insert(id).second);
    CHECK(seen.contains(leaf.system_id()));
    CHECK(id > last);  // the default is smaller than any
    last = id;
  }
}

TEST_CASE("the index of a parameter is the place of its first entry", "[ids]") {
  const ParameterIndex scalar{3}, vector{4, 2};
  const double p[] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  CHECK(p[scalar] == 3.0);
  CHECK(p[vector] == 4.0);
  CHECK(scalar.size == 1);
}
