// From a method to its solver.
#include "saltus/solver/choose.hpp"

#include "saltus/solver/auto_solver.hpp"
#include "saltus/solver/one_step.hpp"

namespace saltus {

std::unique_ptr<Solver> make_solver(Method method, Machine& machine, Watch& watch,
                                    const SolverOptions& options) {
  switch (method) {
    case Method::automatic:
      return std::make_unique<AutoSolver>(machine, watch, options);
    case Method::dopri5:
      return std::make_unique<RungeKutta<Dopri5>>(machine, watch, options);
    case Method::dop853:
      return std::make_unique<RungeKutta<Dop853>>(machine, watch, options);
    case Method::adams:
      return make_cvode(machine, watch, options, CvodeMethod::adams);
    case Method::bdf:
      return make_cvode(machine, watch, options, CvodeMethod::bdf);
  }
  return nullptr;
}

}  // namespace saltus
