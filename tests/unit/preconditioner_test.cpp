// The preconditioner of GMRES: which entries its incomplete factorisation keeps, and how many
// vectors GMRES may use.
#include "../../src/solver/linear/krylov.hpp"

#include "../../src/solver/linear/fill.hpp"
#include "saltus/solver/detail/linear_thresholds.hpp"
#include "support/catch.hpp"

using namespace saltus;
using Catch::Matchers::WithinRel;

namespace {

/// The solution's first entry for the unit matrix of eight states with one more entry in its first
/// row, and a right-hand side of ones: 1 - size if the entry is kept, 1 if it is dropped. Eigen
/// keeps half as many entries of a row as there are states at most, the diagonal among them.
double first_entry(double size) {
  Sparsity places;
  for (int j = 0; j < 8; ++j) {
    if (j == 1) places.rows.push_back(0);
    places.rows.push_back(j);
    places.start.push_back(places.size());
  }
  Preconditioner preconditioner(places);
  preconditioner.jacobian()[1] = -size;
  REQUIRE(preconditioner.factor(1.0));
  const Eigen::VectorXd r = Eigen::VectorXd::Ones(8);
  Eigen::VectorXd z(8);
  preconditioner.solve(r.data(), z.data());
  return z[0];
}

/// A full pattern of n states.
Sparsity full(int n) {
  Sparsity places;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) places.rows.push_back(i);
    places.start.push_back(places.size());
  }
  return places;
}

}  // namespace

// Eigen's ILUT compares an entry with the norm of its row, which is 1 here but for size^2 / 2.
TEST_CASE("entries below a thousandth of their row are dropped, larger ones are kept", "[linear]") {
  for (const double kept : {0.5, 1e-2, 2e-3})
    CHECK_THAT(first_entry(kept), WithinRel(1.0 - kept, 1e-15));
  for (const double dropped : {5e-4, 1e-4, 1e-9}) CHECK(first_entry(dropped) == 1.0);
}

TEST_CASE("the entries of a factor are counted up to a limit, from which on nothing is dearer",
          "[linear]") {
  const int n = 60;
  const double entries = n * (n + 1) / 2.0;  // of one triangle
  CHECK(predicted_fill(full(n), entries).entries == 2.0 * entries);
  CHECK(std::isfinite(predicted_fill(full(n), entries).operations));
  CHECK(std::isinf(predicted_fill(full(n), entries - 1.0).operations));
}

// The count takes about a nanosecond for an entry, and a factorisation 15 for an entry alone.
TEST_CASE("the count of entries stops where a factorisation takes 0.3 s by the entries alone",
          "[linear]") {
  const double seconds = 1e-9 * thresholds::sparse_entry * thresholds::most_factor_entries;
  CHECK_THAT(seconds, WithinRel(0.3, 1e-12));
}
