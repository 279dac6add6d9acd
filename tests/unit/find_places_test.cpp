// The search for places by moving arguments: it finds them all, and no others, in few calls.
#include "saltus/solver/detail/find_places.hpp"

#include <random>

#include "support/catch.hpp"

using namespace saltus;

namespace {

using Matrix = std::vector<std::vector<char>>;  // [value][argument]: 1 where it is read

Matrix empty(Index n) {
  const auto size = static_cast<std::size_t>(n);
  return Matrix(size, std::vector<char>(size));
}

Matrix band(Index n, Index lower, Index upper) {
  Matrix reads = empty(n);
  for (Index i = 0; i < n; ++i)
    for (Index j = std::max(i - lower, Index{0}); j <= std::min(i + upper, n - 1); ++j)
      reads[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = 1;
  return reads;
}

/// A value that reads all, an argument that all read, and the diagonal.
Matrix arrow(Index n) {
  Matrix reads = band(n, 0, 0);
  for (std::size_t k = 0; k < reads.size(); ++k) reads[0][k] = reads[k][0] = 1;
  return reads;
}

Matrix random(Index n, int per_value, std::mt19937& draw) {
  Matrix reads = empty(n);
  for (auto& row : reads)
    for (int k = 0; k < per_value; ++k) row[draw() % row.size()] = 1;
  return reads;
}

Places find(const Matrix& reads) {
  return find_places(static_cast<Index>(reads.size()),
                     [&](std::span<const int> moved, std::vector<char>& changed) {
                       for (std::size_t i = 0; i < reads.size(); ++i)
                         changed[i] = std::ranges::any_of(moved, [&](int j) {
                           return reads[i][static_cast<std::size_t>(j)] != 0;
                         });
                     });
}

Matrix matrix_of(const Sparsity& places) {
  Matrix reads = empty(places.columns());
  for (Index j = 0; j < places.columns(); ++j) {
    CHECK(std::ranges::is_sorted(places.column(j)));
    for (const int i : places.column(j))
      reads[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = 1;
  }
  return reads;
}

void all_found(const Matrix& reads) {
  const Places found = find(reads);
  REQUIRE(found.search == Search::found);
  CHECK(matrix_of(found.places) == reads);
  // Each round takes at most two a group, of which there are n, n / 2, n / 4 ... rounded up.
  const auto n = static_cast<double>(reads.size());
  CHECK(found.calls <= 2.0 * (n + std::log2(n) + 1.0));
}

}  // namespace

TEST_CASE("the places found are the places there are", "[find_places]") {
  std::mt19937 draw(11);
  for (const Index n : {1, 2, 3, 64, 100, 257}) {
    INFO("n = " << n);
    all_found(empty(n));
    for (const auto& [lower, upper] : {std::pair<Index, Index>{0, 0}, {1, 1}, {3, 0}, {0, 5}})
      all_found(band(n, lower, upper));
    all_found(arrow(n));
    all_found(random(n, 3, draw));
  }
}

TEST_CASE("a band costs calls for each halving, not for each argument", "[find_places]") {
  // Neighbouring groups meet, the next but one do not: three colours, two halves, log2(n) rounds.
  for (const Index n : {1024, 4096})
    CHECK(find(band(n, 1, 1)).calls <= 6 * static_cast<int>(std::log2(n)));
}

TEST_CASE("what reads everything is given up early", "[find_places]") {
  const Index n = 512;
  const Places full = find(band(n, n, n));
  CHECK(full.search == Search::full);
  CHECK(full.calls == 2 + 4 + 8 + 16 + 32 + 64);  // until there are 64 groups
  CHECK(full.places.size() == 0);
}

TEST_CASE("one value that reads several thousand arguments is too dear", "[find_places]") {
  Matrix reads = band(4096, 0, 0);
  std::ranges::fill(reads[0], char{1});
  CHECK(find(reads).search == Search::dear);
}
