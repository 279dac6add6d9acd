// CVODE as a Solver. Only files under src/ include the headers of SUNDIALS.
#pragma once

#include <memory>

#include "saltus/solver/detail/solver.hpp"

namespace saltus {

enum class CvodeMethod {
  adams,  ///< Adams-Moulton, orders 1 to 12, fixed-point iteration: long smooth stretches
  bdf     ///< backward differentiation, orders 1 to 5, Newton iteration: stiff scenes
};

/// A. C. Hindmarsh et al., "SUNDIALS: Suite of nonlinear and differential/algebraic equation
/// solvers", ACM TOMS 31 (2005) 363. CVODE's own root-finding watches the guards; the locator
/// refines each root on CVODE's interpolant.
std::unique_ptr<Solver> make_cvode(Machine& machine, GuardSet& guards, const SolverOptions& options,
                                   CvodeMethod method);

}  // namespace saltus
