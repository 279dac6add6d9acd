// Y = U^-1, by LU factorisation with partial pivoting.
#include "saltus/library/matrix_inversion.hpp"

#include <limits>

#include <Eigen/LU>

#include "saltus/base/error.hpp"
#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

namespace {

/// Golub and Van Loan, Matrix Computations, 4th edition, section 3.5: with a condition number of
/// 1 / eps no digit of the inverse is sure.
constexpr double least_reciprocal = std::numeric_limits<double>::epsilon();

void invert(const std::string& block, const At& at, Index rows, VectorRef out) {
  const Eigen::PartialPivLU<MatrixByRows> lu(MatrixView(at.u[0].data(), rows, rows));
  const double reciprocal = lu.rcond();
  if (!(reciprocal >= least_reciprocal))  // NaN, too
    throw SimulationError(
        text("t = ", at.time, " s: the matrix at the input of block '", block,
             "' has no inverse: expected a reciprocal condition number of at least ",
             least_reciprocal, ", found ", reciprocal,
             "; change the model so that the matrix stays regular"),
        at.time, block);
  by_rows(out, rows) = lu.inverse();
}

}  // namespace

MatrixInversion::MatrixInversion(std::string name) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port(
      {.name = "out",
       .calc = [block = this->name()](const At& at,
                                      VectorRef out) { invert(block, at, at.u.columns(0), out); },
       .shape = {},
       .shape_rule =
           [block = this->name()](std::span<const Shape> in) {
             detail::require_matrix_signal(block, in[0]);
             if (in[0].rows() != in[0].columns)
               throw ShapeMismatchError(
                   text("block '", block, "': expected a square matrix, found ", in_words(in[0])));
             return in[0];
           },
       .reads = Reads::inputs});
}

MatrixInversion::MatrixInversion(std::string name, Index rows) : LeafSystem(std::move(name)) {
  detail::require_matrix(this->name(), "the matrix", {rows, rows});
  declare_input_port({.name = "in", .shape = Shape::matrix(rows, rows), .flat = true});
  declare_output_port({.name = "out",
                       .calc = [block = this->name(), rows](
                                   const At& at, VectorRef out) { invert(block, at, rows, out); },
                       .shape = Shape::matrix(rows, rows),
                       .reads = Reads::inputs});
}

}  // namespace saltus
