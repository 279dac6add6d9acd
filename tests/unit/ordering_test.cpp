// Ordering: bandwidths, and the reverse Cuthill-McKee order.
#include "saltus/solver/detail/ordering.hpp"

#include <algorithm>
#include <numeric>

#include "support/catch.hpp"
#include "support/entries.hpp"

using namespace saltus;
using namespace support;

namespace {

std::pair<Index, Index> reach(const Sparsity& all, const std::vector<int>& position = {}) {
  const Bandwidth band = bandwidth(all, position);
  return {band.lower, band.upper};
}

/// These entries with the states renamed at random.
Sparsity shuffled(Index n, std::vector<MatrixEntry> entries, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> name(static_cast<std::size_t>(n));
  std::iota(name.begin(), name.end(), Index{0});
  std::ranges::shuffle(name, random);
  for (MatrixEntry& entry : entries)
    entry = {name[static_cast<std::size_t>(entry.row)],
             name[static_cast<std::size_t>(entry.column)]};
  return places(n, entries);
}

bool is_permutation(std::vector<int> position) {
  std::ranges::sort(position);
  for (std::size_t i = 0; i < position.size(); ++i)
    if (position[i] != static_cast<int>(i)) return false;
  return true;
}

}  // namespace

TEST_CASE("the bandwidth is how far places reach below and above the diagonal", "[ordering]") {
  using Reach = std::pair<Index, Index>;
  CHECK(reach(places({"x..", ".x.", "..x"})) == Reach{0, 0});
  CHECK(reach(places({"xx.", ".x.", "x.x"})) == Reach{2, 1});
  CHECK(reach(places({"xx.", ".x.", "x.x"}), {1, 2, 0}) == Reach{0, 1});
  CHECK(bandwidth(places({"xx.", ".x.", "x.x"})).total() == 4);
  CHECK(bandwidth(places(9, band_entries(9, 2, 1))).total() == 4);
}

TEST_CASE("a hidden band is found, whatever the states are called", "[ordering]") {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Sparsity path = shuffled(200, band_entries(200, 1, 1), seed);
    const auto position = reverse_cuthill_mckee(path);
    CHECK(bandwidth(path).total() > 100);
    CHECK(bandwidth(path, position).total() == 3);  // a path from one end
    CHECK(is_permutation(position));
  }
}

TEST_CASE("separate parts stay together, each a band of its own", "[ordering]") {
  // Two paths of five states, and a state alone, all mixed.
  std::vector<MatrixEntry> entries = band_entries(5, 1, 1);
  for (const auto& [row, column] : band_entries(5, 1, 1)) entries.push_back({row + 5, column + 5});
  entries.push_back({10, 10});
  const Sparsity parts = shuffled(11, entries, 1);
  const auto position = reverse_cuthill_mckee(parts);
  CHECK(bandwidth(parts, position).total() == 3);
  CHECK(is_permutation(position));
}

TEST_CASE("a place on one side of the diagonal counts on both", "[ordering]") {
  // Who reads whom does not matter: lower and upper triangle give the same order.
  CHECK(reverse_cuthill_mckee(places({"x...", ".x..", "x.x.", ".xxx"})) ==
        reverse_cuthill_mckee(places({"x.x.", ".x.x", "..xx", "...x"})));
}

TEST_CASE("a grid of m by n states has a band as wide as its shorter side", "[ordering]") {
  constexpr Index wide = 30, high = 4;
  std::vector<MatrixEntry> entries;
  for (Index i = 0; i < wide * high; ++i) {
    entries.push_back({i, i});
    if (i % wide + 1 < wide) entries.push_back({i, i + 1}), entries.push_back({i + 1, i});
    if (i + wide < wide * high) entries.push_back({i, i + wide}), entries.push_back({i + wide, i});
  }
  const Sparsity grid = places(wide * high, entries);
  CHECK(bandwidth(grid).lower == wide);
  CHECK(bandwidth(grid, reverse_cuthill_mckee(grid)).lower <= high + 1);
}
