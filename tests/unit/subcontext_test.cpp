// The layout of a part: its leaves count from zero, and are called as the part calls them.
#include "saltus/model/detail/subcontext.hpp"

#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// root { a, box { b, c }, d } with one to four entries each.
Layout layout() {
  const auto leaf = [](const char* path, Index x, Index nx, Index p, Index np) {
    Layout::Leaf made;
    made.path = path, made.x = x, made.nx = nx, made.p = p, made.np = np;
    return made;
  };
  return {.leaves = {leaf("a", 0, 1, 0, 1), leaf("box.b", 1, 2, 1, 0), leaf("box.c", 3, 3, 1, 2),
                     leaf("d", 6, 4, 3, 1)},
          .systems = {{{0}, "", 0, 4},
                      {{1}, "a", 0, 1},
                      {{2}, "box", 1, 3},
                      {{3}, "box.b", 1, 2},
                      {{4}, "box.c", 2, 3},
                      {{5}, "d", 3, 4}}};
}

std::pair<Index, Index> states(std::size_t first, std::size_t last) {
  using Leaf = Layout::Leaf;
  return detail::extent(layout(), {{}, "", first, last}, &Leaf::x, &Leaf::nx);
}

}  // namespace

TEST_CASE("the extent of some leaves is where they begin and how many entries they have",
          "[subcontext]") {
  using Extent = std::pair<Index, Index>;
  CHECK(states(0, 4) == Extent{0, 10});
  CHECK(states(1, 3) == Extent{1, 5});
  CHECK(states(3, 4) == Extent{6, 4});
  CHECK(states(2, 2).second == 0);
}

TEST_CASE("the leaves of a part count from zero and lose its name", "[subcontext]") {
  const Layout whole = layout();
  const auto part = detail::part_layout(whole, whole.systems[2]);
  REQUIRE(part->leaves.size() == 2);
  CHECK((part->leaves[0].path == "b" && part->leaves[1].path == "c"));
  CHECK((part->leaves[0].x == 0 && part->leaves[1].x == 2));
  CHECK((part->leaves[0].p == 0 && part->leaves[1].p == 0));
  CHECK(part->leaves[1].np == 2);
  REQUIRE(part->systems.size() == 3);  // itself and its leaves
  CHECK((part->systems[0].first == 0 && part->systems[0].last == 2));
  CHECK((part->systems[2].id == SystemId{4} && part->systems[2].first == 1));
}

TEST_CASE("a leaf alone keeps its path", "[subcontext]") {
  const Layout whole = layout();
  const auto part = detail::part_layout(whole, whole.systems[4]);
  REQUIRE(part->leaves.size() == 1);
  CHECK(part->leaves[0].path == "box.c");
  CHECK((part->leaves[0].x == 0 && part->leaves[0].nx == 3));
  CHECK(part->systems.size() == 1);
}

TEST_CASE("a part put back changes its own entries only", "[subcontext]") {
  DiagramBuilder builder;
  const auto& a = builder.add<Leaf>("a", [](Leaf& l) { declare_ramp(l, 1.0, 1.0); });
  const auto& b = builder.add<Leaf>("b", [](Leaf& l) { declare_ramp(l, 1.0, 2.0); });
  const Diagram diagram = builder.build();
  const Context whole = diagram.create_context();
  const Context part = whole[b.system_id()].with_continuous_state(vec({7.0}));
  CHECK(whole.with_subcontext(b.system_id(), part).continuous_state() == vec({1.0, 7.0}));
  CHECK(whole.with_subcontext(a.system_id(), part).continuous_state() == vec({7.0, 2.0}));
  CHECK(contains(message<ModelError>([&] { whole.with_subcontext(a.system_id(), whole); }),
                 "is not one of 'a': expected 1 continuous"));
}
