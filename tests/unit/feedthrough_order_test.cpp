// FeedthroughOrder: each node after the nodes it needs, and loops by their path.
#include "saltus/model/detail/feedthrough_order.hpp"

#include "saltus/base/error.hpp"
#include "support/catch.hpp"

using namespace saltus;

namespace {

using Graph = std::vector<std::vector<int>>;

std::vector<int> order_of(const Graph& needs) {
  const auto of = [&](int i) -> const std::vector<int>& {
    return needs[static_cast<std::size_t>(i)];
  };
  const auto copy = [&](int i) { return of(i); };
  const auto name = [](int i) { return "n" + std::to_string(i); };
  return detail::FeedthroughOrder(needs.size(), copy, name).run();
}

}  // namespace

TEST_CASE("a node comes after all that it needs, and otherwise by its number", "[order]") {
  CHECK(order_of({}).empty());
  CHECK(order_of({{}, {}, {}}) == std::vector{0, 1, 2});
  CHECK(order_of({{1}, {2}, {}}) == std::vector{2, 1, 0});
  CHECK(order_of({{2}, {}, {1}, {0, 1}}) == std::vector{1, 2, 0, 3});
}

TEST_CASE("a long chain needs no deep stack", "[order]") {
  const int n = 100000;
  Graph needs(n);
  for (int i = 0; i + 1 < n; ++i) needs[static_cast<std::size_t>(i)] = {i + 1};
  const std::vector<int> order = order_of(needs);
  CHECK(order.front() == n - 1);
  CHECK(order.back() == 0);
}

TEST_CASE("a loop is refused, with the nodes of the loop and no others", "[order]") {
  try {
    order_of({{1}, {2}, {3}, {1}, {}});
    FAIL("no loop was found");
  } catch (const Error& error) {
    const std::string message = error.what();
    for (const char* in : {"n1", "n2", "n3"}) CHECK(message.find(in) != std::string::npos);
    for (const char* out : {"n0", "n4"}) CHECK(message.find(out) == std::string::npos);
  }
  CHECK_THROWS_AS(order_of({{0}}), Error);
}
