// The choice of the solver for a method.
#include "saltus/solver/detail/choose.hpp"

#include <algorithm>

#include "saltus/solver/detail/auto_solver.hpp"
#include "saltus/solver/detail/one_step.hpp"
#include "saltus/solver/detail/radau.hpp"
#include "saltus/solver/detail/stiff_thresholds.hpp"
#include "saltus/solver/detail/taylor.hpp"

namespace saltus {

namespace {

/// The rtol below which dop853 takes less time than dopri5.
double order_8_pays(const GuardSet& guards) {
  const bool stops =
      std::ranges::any_of(guards.all(), [](const Guard& each) { return !each.monitor; });
  return stops ? thresholds::order_8_pays_with_guards : thresholds::order_8_pays;
}

}  // namespace

void require_linear_solver(LinearSolver linear_solver, Method method) {
  const bool stiff =
      method == Method::automatic || method == Method::bdf || method == Method::radau;
  if (linear_solver != LinearSolver::automatic && !stiff) {
    throw ModelError(text("option linear_solver = '", to_string(linear_solver),
                          "': ode_solver_method '", to_string(method),
                          "' solves no linear systems; leave it at 'auto', or take the "
                          "method 'bdf', 'radau' or 'auto'"));
  }
  if (linear_solver == LinearSolver::gmres && method == Method::radau) {
    throw ModelError(
        "option linear_solver = 'gmres': ode_solver_method 'radau' factorises its matrices; leave "
        "it "
        "at 'auto', or take the method 'bdf'");
  }
}

void require_series(const Plan& plan, Method method) {
  if (method == Method::taylor && plan.nx > 0) require_taylor_series(plan);
}

std::unique_ptr<Solver> make_solver(Method method, Machine& machine, GuardSet& guards,
                                    const SolverOptions& options) {
  switch (method) {
    case Method::automatic:
      return std::make_unique<AutoSolver>(machine, guards, options,
                                          options.rtol <= order_8_pays(guards)
                                              ? make_dop853(machine, guards, options)
                                              : make_dopri5(machine, guards, options));
    case Method::dopri5:
      return make_dopri5(machine, guards, options);
    case Method::dop853:
      return make_dop853(machine, guards, options);
    case Method::adams:
      return make_cvode(machine, guards, options, CvodeMethod::adams);
    case Method::bdf:
      return make_cvode(machine, guards, options, CvodeMethod::bdf);
    case Method::radau:
      return make_radau(machine, guards, options);
    case Method::taylor:
      return make_taylor(machine, guards, options);
  }
  return nullptr;
}

}  // namespace saltus
