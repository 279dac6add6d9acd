// Direct solvers: their solutions satisfy the equations, with and without pivoting; and which
// elimination factorises a full matrix of which size.
#include "../../src/solver/linear/factorisation.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/LU>

#include "../../src/solver/linear/elimination.hpp"
#include "support/catch.hpp"

using namespace saltus;

namespace {

/// A band of n states. Its diagonal is 4, so that no row moves, or 0.1 in the rows that
/// `moves(i)` says.
template <class Moves>
Eigen::MatrixXd band_matrix(Index n, Bandwidth band, const Moves& moves) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = std::max<Index>(0, j - band.upper); i <= std::min(n - 1, j + band.lower); ++i)
      a(i, j) = std::sin(static_cast<double>(1 + i + 3 * j));
    a(j, j) = moves(j) ? 0.1 : 4.0;
  }
  return a;
}

Sparsity all_places(const Eigen::MatrixXd& a) {
  Sparsity places;
  for (Index j = 0; j < a.cols(); ++j) {
    for (Index i = 0; i < a.rows(); ++i)
      if (a(i, j) != 0.0) places.rows.push_back(static_cast<int>(i));
    places.start.push_back(places.size());
  }
  return places;
}

/// The largest part of A x - b, in units of the rounding of A x.
double residual(Factorisation& solver, const Eigen::MatrixXd& a, const Sparsity& places,
                const MatrixLayout& layout) {
  std::vector<double> matrix(static_cast<std::size_t>(layout.size));
  std::size_t k = 0;
  for (Index j = 0; j < a.cols(); ++j)
    for (const int i : places.column(j))
      matrix[static_cast<std::size_t>(layout.places[k++])] = a(i, j);
  REQUIRE(solver.factor(matrix.data()));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(a.rows(), 1.0, 2.0);
  Eigen::VectorXd x = b;
  solver.solve(x.data());
  const double rounding = 2.3e-16 * (a.cwiseAbs() * x.cwiseAbs()).maxCoeff();
  return (a * x - b).cwiseAbs().maxCoeff() / rounding;
}

/// Rows that move: none, all, every third, the first half, or the last one but one.
const std::vector<bool (*)(Index)> patterns{
    [](Index) { return false; }, [](Index) { return true; }, [](Index i) { return i % 3 == 1; },
    [](Index i) { return i < 10; }, [](Index i) { return i == 18; }};

template <class T>
bool eliminates(Index n) {
  const auto solver = make_dense<T>(n);
  return dynamic_cast<const Elimination<0, T>*>(solver.get()) != nullptr;
}

template <class T>
bool is_unrolled() {
  const auto last = make_dense<T>(8), next = make_dense<T>(9);
  return dynamic_cast<const Elimination<8, T>*>(last.get()) != nullptr &&
         dynamic_cast<const Elimination<9, T>*>(next.get()) == nullptr;
}

}  // namespace

// Gaussian elimination with partial pivoting leaves a residual of n growth roundings (Golub, Van
// Loan, section 3.4.6); in a band each row takes part in lower + upper + 1 eliminations. With 11 at
// most and a growth below ten here: 110.
TEST_CASE("a band solves its equations, wherever rows are exchanged, again and again", "[linear]") {
  for (const Bandwidth band : {Bandwidth{1, 1}, {2, 2}, {3, 1}, {1, 4}, {5, 5}}) {
    const auto solver = make_band<double>(20, band, {});
    for (const auto& moves : patterns) {
      const Eigen::MatrixXd a = band_matrix(20, band, moves);
      const Sparsity places = all_places(a);
      CHECK(residual(*solver, a, places, band_layout(places, band, {})) < 110.0);
    }
    // The fill of the matrix before leaves no trace.
    const Eigen::MatrixXd a = band_matrix(20, band, patterns[0]);
    const Sparsity places = all_places(a);
    CHECK(residual(*solver, a, places, band_layout(places, band, {})) < 110.0);
  }
}

TEST_CASE("a band of states in another order solves the same equations", "[linear]") {
  const Bandwidth band{2, 2};
  const Eigen::MatrixXd a = band_matrix(20, band, patterns[2]);
  std::vector<int> position(20);
  for (int i = 0; i < 20; ++i) position[static_cast<std::size_t>(i)] = 19 - i;
  const auto solver = make_band<double>(20, band, position);
  const Sparsity places = all_places(a);
  CHECK(residual(*solver, a, places, band_layout(places, band, position)) < 110.0);
}

TEST_CASE("a full matrix of few states is unrolled, of many in blocks, between eliminated",
          "[linear]") {
  CHECK(is_unrolled<double>());
  CHECK(is_unrolled<Complex>());
  for (const Index n : {1, 8, 48, 49, 200}) CHECK_FALSE(eliminates<double>(n));
  for (const Index n : {9, 20, 47}) CHECK(eliminates<double>(n));
  for (const Index n : {8, 48}) CHECK_FALSE(eliminates<Complex>(n));
  for (const Index n : {9, 47}) CHECK(eliminates<Complex>(n));
}

TEST_CASE("full matrices of all sizes around the limits solve their equations", "[linear]") {
  for (const Index n : {1, 2, 7, 8, 9, 47, 48, 49}) {
    const Eigen::MatrixXd a = band_matrix(n, {n, n}, patterns[2]);
    const Sparsity places = all_places(a);
    CHECK(residual(*make_dense<double>(n), a, places, dense_layout(places)) <
          10.0 * static_cast<double>(n + 10));
  }
}
