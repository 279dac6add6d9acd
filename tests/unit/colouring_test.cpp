// Colouring: columns that one difference tells apart, few colours, and only what is asked for.
#include "saltus/solver/detail/colouring.hpp"

#include "support/catch.hpp"
#include "support/entries.hpp"

using namespace saltus;
using namespace support;

namespace {

/// All places by differences.
JacobianPattern pattern(Sparsity all) {
  std::vector<char> differences(all.rows.size(), 1);
  return {.places = std::move(all), .own = {}, .differences = std::move(differences)};
}

}  // namespace

TEST_CASE("no two columns of a colour meet in a row, and each column has one", "[colouring]") {
  std::mt19937 random(4711);
  for (int round = 0; round < 40; ++round) {
    const Index n = 2 + round;
    const Sparsity all = places(n, random_entries(n, round % 5, random));
    const Colouring colouring = colour(pattern(all));
    std::vector<int> columns = colouring.columns;
    std::ranges::sort(columns);
    for (int j = 0; j < n; ++j) CHECK(columns.at(static_cast<std::size_t>(j)) == j);
    for (Index c = 0; c < colouring.colours(); ++c) {
      std::vector<int> met(static_cast<std::size_t>(n));
      for (const int j : colouring.of(c))
        for (const int i : all.column(j)) CHECK(++met[static_cast<std::size_t>(i)] == 1);
    }
  }
}

TEST_CASE("a band takes as many colours as it is wide", "[colouring]") {
  for (const auto& [lower, upper] : {std::pair<Index, Index>{1, 1}, {2, 2}, {0, 3}, {4, 1}})
    CHECK(colour(pattern(places(60, band_entries(60, lower, upper)))).colours() ==
          lower + upper + 1);
  CHECK(colour(pattern(places(60, band_entries(60, 0, 0)))).colours() == 1);
}

TEST_CASE("where a row reads over half of the columns each has a colour of its own",
          "[colouring]") {
  const Colouring colouring = colour(pattern(places({"xxx.", ".x..", "..x.", "...x"})));
  CHECK(colouring.colours() == 4);  // three would do
  CHECK(colouring.columns == std::vector{0, 1, 2, 3});
  CHECK(colour(pattern(places({"xx..", ".x..", "..x.", "...x"}))).colours() == 2);
}

TEST_CASE("columns that differences need not find have no colour", "[colouring]") {
  JacobianPattern known = pattern(places({"xx.", "xx.", "..x"}));
  known.differences = {0, 0, 0, 0, 1};  // the block of the first two is known
  const Colouring colouring = colour(known);
  CHECK(colouring.columns == std::vector{2});
  CHECK(colouring.colours() == 1);
}

TEST_CASE("a column that is known may share a row with one that is sought", "[colouring]") {
  // Row 0 is sought in column 1 only, but column 0 moves it as well if both are moved.
  JacobianPattern known = pattern(places({"xx..", "x...", "..x.", "...x"}));
  known.differences = {0, 1, 1, 1, 1};
  const Colouring colouring = colour(known);
  for (Index c = 0; c < colouring.colours(); ++c) {
    const auto all = colouring.of(c);
    CHECK(!(std::ranges::count(all, 0) > 0 && std::ranges::count(all, 1) > 0));
  }
}
