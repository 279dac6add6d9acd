// Adams' corrector: CVODE's test of convergence, with a look at the contraction before it.
#pragma once

#include "saltus/solver/detail/contraction.hpp"
#include "sundials_compat.hpp"

namespace saltus::sun {

/// Refuses a step whose fixed-point iteration converges too slowly beside fast modes, and lowers
/// the tolerance of CVODE's own test where it converges slowly: see Contraction.
class Corrector {
 public:
  /// Put between the solver and CVODE's own test, after CVodeSetNonlinearSolver.
  void attach(SUNNonlinearSolver solver) {
    const auto* content = static_cast<SUNNonlinearSolverContent_FixedPoint>(solver->content);
    test_ = content->CTest, data_ = content->ctest_data;
    SUNNonlinSolSetConvTestFn(solver, converged, this);
  }

 private:
  static int converged(SUNNonlinearSolver solver, N_Vector y, N_Vector change,
                       sunrealtype tolerance, N_Vector weights, void* self) {
    return static_cast<Corrector*>(self)->test(solver, y, change, tolerance, weights);
  }
  int test(SUNNonlinearSolver solver, N_Vector y, N_Vector change, double tolerance,
           N_Vector weights) {
    int iteration = 0;
    SUNNonlinSolGetCurIter(solver, &iteration);
    if (!contraction_.look(N_VWrmsNorm(change, weights), iteration == 0, tolerance))
      return SUN_NLS_CONV_RECVR;
    return test_(solver, y, change, tolerance * contraction_.share(), weights, data_);
  }

  SUNNonlinSolConvTestFn test_ = nullptr;  // CVODE's own
  void* data_ = nullptr;
  Contraction contraction_;
};

}  // namespace saltus::sun
