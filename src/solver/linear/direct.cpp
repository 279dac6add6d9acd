// Tables of functions for SUNDIALS: a matrix and a direct linear solver of our own.
#include "direct.hpp"
#include "saltus/base/list.hpp"

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace saltus::sun {

namespace {

struct MatrixContent {
  std::vector<double> values;
  const MatrixLayout* layout;
};

MatrixContent& content_of(SUNMatrix matrix) {
  return *static_cast<MatrixContent*>(matrix->content);
}

SUNMatrix clone(SUNMatrix matrix) {
  try {
    return make_matrix(*content_of(matrix).layout, matrix->sunctx).release();
  } catch (...) {
    return nullptr;  // SUNDIALS reports a lack of memory
  }
}

void destroy(SUNMatrix matrix) {
  delete static_cast<MatrixContent*>(matrix->content);
  SUNMatFreeEmpty(matrix);
}

int zero(SUNMatrix matrix) {
  std::ranges::fill(content_of(matrix).values, 0.0);
  return 0;
}

int copy(SUNMatrix from, SUNMatrix to) {
  std::ranges::copy(content_of(from).values, content_of(to).values.begin());
  return 0;
}

/// A becomes c A + I.
int scale_add_identity(double c, SUNMatrix matrix) {
  MatrixContent& content = content_of(matrix);
  for (double& value : content.values) value *= c;
  for (const Index place : content.layout->diagonal) nth(content.values, place) += 1.0;
  return 0;
}

struct SolverContent {
  Factorisation* factorisation;
  std::exception_ptr* error;
};

SolverContent& content_of(SUNLinearSolver solver) {
  return *static_cast<SolverContent*>(solver->content);
}

/// A singular matrix is the recoverable error 1: CVODE tries again with a shorter step and a new
/// Jacobian.
int setup(SUNLinearSolver solver, SUNMatrix matrix) {
  const SolverContent& content = content_of(solver);
  try {
    return content.factorisation->factor(values_of(matrix)) ? 0 : 1;
  } catch (...) {
    *content.error = std::current_exception();
    return -1;
  }
}

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, double) {
  double* to = N_VGetArrayPointer(x);
  std::copy_n(N_VGetArrayPointer(b), N_VGetLength(b), to);
  content_of(solver).factorisation->solve(to);
  return 0;
}

int free_solver(SUNLinearSolver solver) {
  delete static_cast<SolverContent*>(solver->content);
  SUNLinSolFreeEmpty(solver);
  return 0;
}

}  // namespace

double* values_of(SUNMatrix matrix) { return content_of(matrix).values.data(); }

Matrix make_matrix(const MatrixLayout& layout, SUNContext context) {
  auto content = std::make_unique<MatrixContent>(
      MatrixContent{std::vector<double>(static_cast<std::size_t>(layout.size)), &layout});
  SUNMatrix matrix = SUNMatNewEmpty(context);
  if (matrix == nullptr) throw Error("SUNDIALS: out of memory");
  matrix->content = content.release();
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->clone = clone, matrix->ops->destroy = destroy;
  matrix->ops->zero = zero, matrix->ops->copy = copy;
  matrix->ops->scaleaddi = scale_add_identity;
  return Matrix(matrix);
}

Linear make_direct(Factorisation& factorisation, std::exception_ptr& error, SUNContext context) {
  auto content = std::make_unique<SolverContent>(SolverContent{&factorisation, &error});
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  if (solver == nullptr) throw Error("SUNDIALS: out of memory");
  solver->content = content.release();
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->setup = setup, solver->ops->solve = solve, solver->ops->free = free_solver;
  return Linear(solver);
}

}  // namespace saltus::sun
