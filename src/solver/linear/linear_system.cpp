// Choice, set-up and callbacks of the linear solver.
#include "linear_system.hpp"

#include <utility>

#include <sunlinsol/sunlinsol_spgmr.h>

#include "saltus/solver/detail/thresholds.hpp"

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
    : machine_(&machine), options_(options), error_(&error), probe_(machine) {
  if (options.find_sparsity) probe_.look(t, x);
  build();
}

void LinearSystem::build() {
  jacobian_.emplace(*machine_, probe_.found());
  choice_ = choose_linear_solver(*jacobian_, machine_->plan().nx, options_.linear_solver);
  factorisation_.reset(), preconditioner_.reset(), words_.clear();
  if (choice_.solver != LinearSolver::gmres)
    make_factorisation();
  else if (!jacobian_->pattern().overflow)
    preconditioner_.emplace(jacobian_->pattern().places);
}

bool LinearSystem::renew(int flag) {
  const bool failed = flag == CV_CONV_FAILURE && !probe_.found().empty();
  if (!std::exchange(news_, false) && !failed) return false;
  if (failed)
    probe_.give_up("Newton's iteration did not converge with what was found");
  else if (++renewals_ > thresholds::most_renewals)
    probe_.give_up(text("others were missing ", thresholds::most_renewals, " times"));
  build();
  return true;
}

/// Whether the probe found new places. The places found near one state may be too few near another.
/// A false alarm, by a kink or by rounding, doubles the time to the next look.
bool LinearSystem::doubtful(double t, const double* x, const double* xdot, const double* values) {
  if (probe_.found().empty() || --until_check_ > 0) return false;
  const bool explained = jacobian_->explains(t, x, xdot, increments(), values);
  news_ = !explained && probe_.look(t, x);
  if (!explained && !news_) wait_ *= 2;
  until_check_ = wait_;
  return news_;
}

void LinearSystem::make_factorisation() {
  const Index n = machine_->plan().nx;
  if (jacobian_->pattern().overflow) jacobian_->fill_up();
  const Sparsity& places = jacobian_->pattern().places;
  if (choice_.solver == LinearSolver::dense) {
    layout_ = dense_layout(places);
    factorisation_ = make_dense(n);
  } else if (choice_.solver == LinearSolver::band) {
    layout_ = band_layout(places, choice_.band, choice_.position);
    factorisation_ = make_band(n, choice_.band, choice_.position);
  } else {
    layout_ = sparse_layout(places);
    factorisation_ = make_sparse(places);
  }
  jacobian_->store_at(std::move(layout_.places));
}

void LinearSystem::attach(void* cvode, N_Vector y, SUNContext context, const Callbacks& callbacks) {
  cvode_ = cvode;
  if (factorisation_) {
    matrix_ = sun::make_matrix(layout_, context);
    linear_ = sun::make_direct(*factorisation_, *error_, context);
    CVodeSetLinearSolver(cvode, linear_.get(), matrix_.get());
    CVodeSetJacFn(cvode, callbacks.jacobian);
    if (machine_->plan().nx <= thresholds::fresh_jacobian) refresh_often();
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
  Increments by{.rtol = options_.rtol,
                .atol = options_.atol,
                .rtols = options_.each_rtol(),
                .atols = options_.each_atol()};
  CVodeGetCurrentStep(cvode_, &by.h);
  return by;
}

int LinearSystem::jacobian(double t, N_Vector x, N_Vector xdot, SUNMatrix out) {
  const double *at = N_VGetArrayPointer(x), *speed = N_VGetArrayPointer(xdot);
  double* values = sun::values_of(out);
  if (!(*jacobian_)(t, at, speed, increments(), values)) return 1;
  return doubtful(t, at, speed, values) ? -1 : 0;
}

int LinearSystem::prepare(double t, N_Vector x, N_Vector xdot, bool keep, bool& renewed,
                          double gamma) {
  renewed = !keep;
  if (!keep && !(*jacobian_)(t, N_VGetArrayPointer(x), N_VGetArrayPointer(xdot), increments(),
                             preconditioner_->jacobian()))
    return 1;
  return preconditioner_->factor(gamma) ? 0 : 1;
}

int LinearSystem::precondition(N_Vector r, N_Vector z) {
  preconditioner_->solve(N_VGetArrayPointer(r), N_VGetArrayPointer(z));
  return 0;
}

const std::string& LinearSystem::describe() const {
  if (std::exchange(told_, jacobian_->mended()) != jacobian_->mended() || words_.empty()) {
    words_ = text(linear_solver_names[static_cast<std::size_t>(choice_.solver)].first, ": ",
                  choice_.why, probe_.words(), jacobian_->words());
  }
  return words_;
}

}  // namespace saltus
