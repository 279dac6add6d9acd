// Choice, set-up and callbacks of the linear solver.
#include "linear_system.hpp"

#include <utility>

#include <sunlinsol/sunlinsol_spgmr.h>

#include "saltus/solver/detail/linear_thresholds.hpp"

namespace saltus {

namespace {

/// In the first iteration of Newton's method, CVODE accepts a residual that was reduced, but not to
/// its tolerance. The correction is too small then, and the test of convergence passes, because it
/// looks at the size of the correction. This function fails instead, so that CVODE tries a shorter
/// step.
int solve_or_fail(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                  double tolerance) {
  const int flag = SUNLinSolSolve_SPGMR(solver, matrix, x, b, tolerance);
  return flag == SUNLS_RES_REDUCED ? SUNLS_CONV_FAIL : flag;
}

}  // namespace

LinearSystem::LinearSystem(Machine& machine, const SolverOptions& options,
                           std::exception_ptr& error, double t, const double* x)
    : n_(machine.plan().nx), error_(&error), structure_(machine, options, t, x) {
  build();
}

void LinearSystem::build() {
  factorisation_.reset(), preconditioner_.reset();
  if (structure_.direct())
    factorisation_ = structure_.make_factorisation<double>();
  else if (!structure_.pattern().overflow)
    preconditioner_.emplace(structure_.pattern().places);
}

bool LinearSystem::renew(int flag) {
  if (!structure_.renew(flag == CV_CONV_FAILURE)) return false;
  build();
  return true;
}

void LinearSystem::attach(void* cvode, N_Vector y, SUNContext context, const Callbacks& callbacks) {
  cvode_ = cvode;
  if (factorisation_) {
    matrix_ = sun::make_matrix(structure_.layout(), context);
    linear_ = sun::make_direct(*factorisation_, *error_, context);
    CVodeSetLinearSolver(cvode, linear_.get(), matrix_.get());
    CVodeSetJacFn(cvode, callbacks.jacobian);
    if (n_ <= thresholds::fresh_jacobian) refresh_often();
    return;
  }
  // The preconditioner is on the right, so that GMRES tests the residual itself. With an inaccurate
  // preconditioner on the left, a step without any correction looks converged.
  linear_.reset(SUNLinSol_SPGMR(y, preconditioner_ ? SUN_PREC_RIGHT : SUN_PREC_NONE,
                                thresholds::krylov_vectors, context));
  if (!linear_) throw Error("SUNDIALS: out of memory");
  linear_->ops->solve = solve_or_fail;
  CVodeSetLinearSolver(cvode, linear_.get(), nullptr);
  if (preconditioner_) CVodeSetPreconditioner(cvode, callbacks.prepare, callbacks.precondition);
}

/// Renews the Jacobian often. With a Jacobian fifty steps old, Newton's corrections may be too
/// small by as much as an eigenvalue has moved since. The test of convergence still passes, because
/// it looks at their size: the Oregonator left its slow manifold by a hundred tolerances and failed
/// in 62 of 200 runs at rtol 1e-4. For a small system a new Jacobian costs about one or two calls
/// of the right-hand side.
void LinearSystem::refresh_often() {
  CVodeSetJacEvalFrequency(cvode_, 1);
  CVodeSetLSetupFrequency(cvode_, thresholds::setup_steps);
}

Increments LinearSystem::increments() const {
  double h = 0.0;
  CVodeGetCurrentStep(cvode_, &h);
  return structure_.increments(h);
}

int LinearSystem::jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out) {
  const double *at = N_VGetArrayPointer(x), *speed = N_VGetArrayPointer(xdot);
  double* values = sun::values_of(out);
  const Increments by = increments();
  if (!structure_.jacobian()(t, at, speed, by, values)) return 1;
  return structure_.misses_places(t, at, speed, by, values) ? -1 : 0;
}

int LinearSystem::prepare(double t, N_Vector x, N_Vector xdot, bool keep, bool& renewed,
                          double gamma) {
  renewed = !keep;
  if (!keep && !structure_.jacobian()(t, N_VGetArrayPointer(x), N_VGetArrayPointer(xdot),
                                      increments(), preconditioner_->jacobian()))
    return 1;
  return preconditioner_->factor(gamma) ? 0 : 1;
}

int LinearSystem::precondition(N_Vector r, N_Vector z) {
  preconditioner_->solve(N_VGetArrayPointer(r), N_VGetArrayPointer(z));
  return 0;
}

}  // namespace saltus
