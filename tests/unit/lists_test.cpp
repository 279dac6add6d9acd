// Lists: many lists in two arrays, from pairs in any order.
#include "saltus/plan/detail/lists.hpp"

#include <algorithm>

#include "support/catch.hpp"

using saltus::detail::Lists;

namespace {

std::vector<int> of(const Lists& lists, int number) {
  return {lists[number].begin(), lists[number].end()};
}

}  // namespace

TEST_CASE("each number has its followers, in the order of the pairs", "[lists]") {
  const Lists lists(4, {{2, 7}, {0, 5}, {2, 3}, {0, 6}, {2, 9}});
  CHECK(of(lists, 0) == std::vector{5, 6});
  CHECK(of(lists, 1).empty());
  CHECK(of(lists, 2) == std::vector{7, 3, 9});
  CHECK(of(lists, 3).empty());
}

TEST_CASE("a pair that comes twice is there twice, and no pair is lost", "[lists]") {
  std::vector<std::pair<int, int>> pairs;
  for (int k = 0; k < 100; ++k) pairs.emplace_back(k * 37 % 11, k);
  pairs.emplace_back(4, 200), pairs.emplace_back(4, 200);
  const Lists lists(11, pairs);
  std::size_t total = 0;
  for (int number = 0; number < 11; ++number) {
    total += lists[number].size();
    for (const int follower : lists[number])
      CHECK(number == (follower == 200 ? 4 : follower * 37 % 11));
  }
  CHECK(total == pairs.size());
  CHECK(std::ranges::count(lists[4], 200) == 2);
}

TEST_CASE("numbers without any pair have empty lists", "[lists]") {
  const Lists lists(2, {});
  CHECK((lists[0].empty() && lists[1].empty()));
}
