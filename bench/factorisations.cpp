// Are our direct solvers worth their code? Ours against SUNDIALS's band and dense modules, and
// against Eigen's LU of a fixed size, on the matrices of BDF: I - h J, one factorisation and three
// solves, as CVODE asks for them. `factorisations ours dense 8 0 1000` for callgrind.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <Eigen/LU>

#include "../src/solver/linear/factorisation.hpp"
#include "interleave.hpp"

namespace {

using saltus::Bandwidth;
using saltus::Index;

constexpr int solves = 3;

/// A full matrix, or a band with `width` diagonals on each side.
struct Problem {
  Index n, width;  // width 0: full

  bool full() const { return width == 0; }
  Bandwidth band() const { return {width, width}; }
  bool has(Index i, Index j) const { return full() || std::abs(i - j) <= width; }
  /// Entry (i, j) of I - h J: J's diagonal is the largest of its column, as in most stiff scenes.
  static double entry(Index i, Index j) {
    return i == j ? 4.0 : std::sin(static_cast<double>(1 + i + 3 * j));
  }
  std::vector<double> right_side() const {
    std::vector<double> b(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) b[static_cast<std::size_t>(i)] = 1.0 + static_cast<double>(i % 3);
    return b;
  }
};

/// Sets the matrix up, and solves; returns an entry of the solution.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual double operator()() = 0;
};

class Ours final : public Solver {
 public:
  explicit Ours(const Problem& p) : b_(p.right_side()), x_(b_) {
    const saltus::Sparsity places = places_of(p);
    const auto layout =
        p.full() ? saltus::dense_layout(places) : saltus::band_layout(places, p.band(), {});
    matrix_.resize(static_cast<std::size_t>(layout.size));
    std::size_t k = 0;
    for (Index j = 0; j < p.n; ++j)
      for (const int i : places.column(j))
        matrix_[static_cast<std::size_t>(layout.places[k++])] = Problem::entry(i, j);
    work_ = matrix_;
    solver_ =
        p.full() ? saltus::make_dense<double>(p.n) : saltus::make_band<double>(p.n, p.band(), {});
  }
  double operator()() override {
    work_ = matrix_;
    if (!solver_->factor(work_.data())) std::abort();
    for (int k = 0; k < solves; ++k) x_ = b_, solver_->solve(x_.data());
    return x_[0];
  }

 private:
  static saltus::Sparsity places_of(const Problem& p) {
    saltus::Sparsity places;
    for (Index j = 0; j < p.n; ++j) {
      for (Index i = 0; i < p.n; ++i)
        if (p.has(i, j)) places.rows.push_back(static_cast<int>(i));
      places.start.push_back(places.size());
    }
    return places;
  }
  std::vector<double> b_, x_, matrix_, work_;
  std::unique_ptr<saltus::Factorisation> solver_;
};

class Sundials final : public Solver {
 public:
  explicit Sundials(const Problem& p) : b_(p.right_side()) {
    SUNContext_Create(SUN_COMM_NULL, &context_);
    const auto n = static_cast<sunindextype>(p.n), width = static_cast<sunindextype>(p.width);
    matrix_ = p.full() ? SUNDenseMatrix(n, n, context_) : SUNBandMatrix(n, width, width, context_);
    for (sunindextype j = 0; j < n; ++j)
      for (sunindextype i = 0; i < n; ++i)
        if (p.has(i, j))
          (p.full() ? SM_ELEMENT_D(matrix_, i, j) : SM_ELEMENT_B(matrix_, i, j)) =
              Problem::entry(i, j);
    work_ = SUNMatClone(matrix_);
    x_ = N_VNew_Serial(n, context_), right_ = N_VMake_Serial(n, b_.data(), context_);
    solver_ = p.full() ? SUNLinSol_Dense(x_, work_, context_) : SUNLinSol_Band(x_, work_, context_);
    SUNLinSolInitialize(solver_);
  }
  Sundials(const Sundials&) = delete;
  Sundials& operator=(const Sundials&) = delete;
  ~Sundials() override {
    SUNLinSolFree(solver_), N_VDestroy(x_), N_VDestroy(right_);
    SUNMatDestroy(work_), SUNMatDestroy(matrix_), SUNContext_Free(&context_);
  }
  double operator()() override {
    SUNMatCopy(matrix_, work_);
    if (SUNLinSolSetup(solver_, work_) != 0) std::abort();
    for (int k = 0; k < solves; ++k) SUNLinSolSolve(solver_, work_, x_, right_, 0.0);
    return N_VGetArrayPointer(x_)[0];
  }

 private:
  std::vector<double> b_;
  SUNContext context_ = nullptr;
  SUNMatrix matrix_ = nullptr, work_ = nullptr;
  N_Vector x_ = nullptr, right_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

/// Eigen's LU with partial pivoting; N is the number of states, or Eigen::Dynamic.
template <int N>
class ByEigen final : public Solver {
 public:
  explicit ByEigen(const Problem& p) : matrix_(p.n, p.n), lu_(p.n) {
    const auto b = p.right_side();
    b_ = Eigen::Map<const Eigen::VectorXd>(b.data(), p.n), x_ = b_;
    for (Index j = 0; j < p.n; ++j)
      for (Index i = 0; i < p.n; ++i) matrix_(i, j) = Problem::entry(i, j);
  }
  double operator()() override {
    lu_.compute(matrix_);
    if (!(lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0)) std::abort();
    for (int k = 0; k < solves; ++k) {
      x_ = b_;
      lu_.permutationP().applyThisOnTheLeft(x_);
      lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(x_);
      lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(x_);
    }
    return x_[0];
  }

 private:
  Eigen::Matrix<double, N, N> matrix_;
  Eigen::Matrix<double, N, 1> b_, x_;
  Eigen::PartialPivLU<Eigen::Matrix<double, N, N>> lu_;
};

template <int... N>
std::unique_ptr<Solver> by_eigen(const Problem& p, std::integer_sequence<int, N...>) {
  std::unique_ptr<Solver> solver;
  (void)((p.n == N + 1 && (solver = std::make_unique<ByEigen<N + 1>>(p), true)) || ...);
  return solver ? std::move(solver) : std::make_unique<ByEigen<Eigen::Dynamic>>(p);
}

std::unique_ptr<Solver> by(const std::string& who, const Problem& p) {
  if (who == "ours") return std::make_unique<Ours>(p);
  if (who == "sundials") return std::make_unique<Sundials>(p);
  return by_eigen(p, std::make_integer_sequence<int, 8>());
}

void compare(const Problem& p) {
  const auto ours = by("ours", p), sundials = by("sundials", p),
             eigen = p.full() ? by("eigen", p) : nullptr;
  if (std::abs((*ours)() - (*sundials)()) > 1e-9) std::abort();
  std::vector<std::function<void()>> runs{[&] { (*ours)(); }, [&] { (*sundials)(); }};
  if (eigen) runs.emplace_back([&] { (*eigen)(); });
  const auto times = bench::interleave(runs, 21, 1e-3);
  std::printf("%-6s n = %4td, width %td  %12.3f us  sundials %6.2f", p.full() ? "dense" : "band",
              p.n, p.width, times[0].time * 1e6, times[1].ratio);
  if (eigen) std::printf("  eigen %6.2f", times[2].ratio);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 5) {
    const auto solver = by(argv[1], {std::atoi(argv[3]), std::atoi(argv[4])});
    for (int k = std::atoi(argv[5]); k > 0; --k) (*solver)();
    return 0;
  }
  std::printf("ratios to ours: a factorisation and %d solves\n", solves);
  for (const Index n : {1, 2, 3, 4, 5, 6, 8, 9, 12, 15, 20, 32, 47, 64, 100, 200}) compare({n, 0});
  for (const Index n : {20, 100, 1000})
    for (const Index width : {1, 2, 3, 5}) compare({n, width});
}
