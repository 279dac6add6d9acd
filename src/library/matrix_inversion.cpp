// Y = U^-1, by LU factorisation with partial pivoting.
#include "saltus/library/matrix_inversion.hpp"

#include <limits>

#include <Eigen/LU>

#include "saltus/base/error.hpp"
#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

namespace {

using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Golub and Van Loan, Matrix Computations, 4th edition, section 3.5: with a condition number of
/// 1 / eps no digit of the inverse is sure.
constexpr double least_reciprocal = std::numeric_limits<double>::epsilon();

void invert(const std::string& block, const At& at, Index rows, VectorRef out) {
  const Eigen::Map<const ByRows> matrix(at.u[0].data(), rows, rows);
  const Eigen::PartialPivLU<ByRows> lu(matrix);
  const double reciprocal = lu.rcond();
  if (!(reciprocal >= least_reciprocal))  // NaN, too
    throw SimulationError(
        text("t = ", at.time, " s: the matrix at the input of block '", block,
             "' has no inverse: expected a reciprocal condition number of at least ",
             least_reciprocal, ", found ", reciprocal,
             "; change the model so that the matrix stays regular"),
        at.time, block);
  Eigen::Map<ByRows>(out.data(), rows, rows) = lu.inverse();
}

}  // namespace

MatrixInversion::MatrixInversion(std::string name, Index rows) : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "the matrix", {rows, rows});
  declare_input_port({.name = "in", .shape = Shape::of(rows * rows)});
  declare_output_port({.name = "out",
                       .calc = [block = this->name(), rows](
                                   const At& at, VectorRef out) { invert(block, at, rows, out); },
                       .shape = Shape::of(rows * rows),
                       .reads = Reads::inputs});
}

}  // namespace saltus
