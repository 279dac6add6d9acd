// DOPRI5, compiled.
#include "one_step_sizes.hpp"
#include "saltus/solver/detail/dopri5.hpp"

namespace saltus {

template class RungeKutta<Dopri5>;

std::unique_ptr<OneStepSolver> make_dopri5(Machine& machine, GuardSet& guards,
                                           const SolverOptions& options) {
  return make_one_step<Dopri5>(machine, guards, options);
}

}  // namespace saltus
