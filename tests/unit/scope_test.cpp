// Scope: every guard and every edge of a scene is in it once, in the order of the plan.
#include "saltus/simulation/detail/scope.hpp"

#include <vector>

#include "support/catch.hpp"

using namespace saltus;

namespace {

using Numbers = std::vector<std::size_t>;
using Kind = GuardGroup::Kind;

constexpr int relation = 7, boolean = 9;  // nodes

/// Guards 0, 1 and 4 are of zero crossings, guard 2 is of a relation, and guard 3 of an opaque
/// boolean. The first edge is decided by the relation, the second by both, the third by none.
Plan scene() {
  Plan plan;
  plan.guards = std::vector<GuardGroup>{
      {.kind = Kind::crossing, .slot = 0, .size = 2},
      {.kind = Kind::relation, .index = relation, .slot = 2},
      {.kind = Kind::opaque, .index = boolean, .slot = 3},
      {.kind = Kind::crossing, .slot = 4},
  };
  plan.guard_slots = 5;
  plan.edges.resize(3);
  plan.edges[0].relations = std::vector<int>{relation};
  plan.edges[1].relations = std::vector<int>{boolean, relation};
  return plan;
}

}  // namespace

TEST_CASE("each guard is either of a zero crossing or of a relation, in the order of the plan") {
  const Scope scope(scene());
  CHECK(scope.crossings == Numbers{0, 1, 4});
  CHECK(scope.relations == Numbers{2, 3});
  CHECK(scope.edges == Numbers{0, 1, 2});
}

TEST_CASE("an edge knows the guards that decide it, and a guard the edges that it decides") {
  const Scope scope(scene());
  REQUIRE(scope.deciders.size() == 3);
  CHECK(scope.deciders[0] == Numbers{2});
  CHECK(scope.deciders[1] == Numbers{2, 3});
  CHECK(scope.deciders[2].empty());
  REQUIRE(scope.decided.size() == 5);
  CHECK(scope.decided[2] == Numbers{0, 1});
  CHECK(scope.decided[3] == Numbers{1});
  for (const int crossing : {0, 1, 4}) CHECK(scope.decided[crossing].empty());
}

TEST_CASE("a scene without guards has an empty scope") {
  const Scope scope{Plan{}};
  CHECK(scope.crossings.empty());
  CHECK(scope.relations.empty());
  CHECK(scope.edges.empty());
}
