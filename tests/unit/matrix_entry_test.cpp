// The entries of a band matrix, column by column, none outside the matrix.
#include "saltus/base/matrix_entry.hpp"

#include "support/catch.hpp"

using namespace saltus;
using Entries = std::vector<MatrixEntry>;

TEST_CASE("a tridiagonal matrix has its three diagonals, column by column", "[matrix_entry]") {
  CHECK(band_entries(3, 1, 1) == Entries{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}, {2, 2}});
}

TEST_CASE("lower and upper are not mixed up", "[matrix_entry]") {
  CHECK(band_entries(3, 0, 2) == Entries{{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}});
  CHECK(band_entries(3, 2, 0) == Entries{{0, 0}, {1, 0}, {2, 0}, {1, 1}, {2, 1}, {2, 2}});
}

TEST_CASE("a band wider than the matrix is all of it; no state has no entry", "[matrix_entry]") {
  CHECK(band_entries(4, 9, 9).size() == 16);
  CHECK(band_entries(5, 0, 0).size() == 5);
  CHECK(band_entries(0, 1, 1).empty());
}
