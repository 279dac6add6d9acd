// The stepper unrolled for the number of states, or the general stepper.
#pragma once

#include "saltus/solver/detail/runge_kutta.hpp"

namespace saltus {

template <Tableau Method>
std::unique_ptr<OneStepSolver> make_one_step(Machine& machine, GuardSet& guards,
                                             const SolverOptions& options) {
  switch (machine.plan().nx) {
    case 1:
      return std::make_unique<RungeKutta<Method, 1>>(machine, guards, options);
    case 2:
      return std::make_unique<RungeKutta<Method, 2>>(machine, guards, options);
    case 3:
      return std::make_unique<RungeKutta<Method, 3>>(machine, guards, options);
    case 4:
      return std::make_unique<RungeKutta<Method, 4>>(machine, guards, options);
    default:
      return std::make_unique<RungeKutta<Method>>(machine, guards, options);
  }
}

}  // namespace saltus
