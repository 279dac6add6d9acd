// DOP853, compiled.
#include "one_step_sizes.hpp"
#include "saltus/solver/detail/dop853.hpp"

namespace saltus {

template class RungeKutta<Dop853>;

std::unique_ptr<OneStepSolver> make_dop853(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options) {
  return make_one_step<Dop853>(machine, guards, options);
}

}  // namespace saltus
