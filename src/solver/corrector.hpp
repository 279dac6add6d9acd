// The fixed-point iteration of Adams beside fast modes: it has to converge fast, or the step is
// refused.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/solver/detail/thresholds.hpp"
#include "sundials_compat.hpp"

namespace saltus::sun {

/// Let q be the ratio of two changes in the iteration, about h |lambda| beta for the fastest mode.
/// CVODE accepts any q up to 2, and a rest of 0.1 tolerances. The derivative at the end of the step
/// is then wrong by |lambda| times the rest. Near the imaginary axis nothing damps that, and the
/// errors of many steps add up: modes of -0.1 +- 1000i that are not excited, over 30 s, ended
/// 6 000 to 12 000 tolerances off without a word. So CVODE's test gets a smaller tolerance where q
/// is large, and a larger q is refused: CVODE takes a shorter step. With these numbers the same run
/// is within a tolerance, and +- 30i within 30 in place of 2000, for 1.01 times the calls of the
/// shelf (geometric mean; rtol 1e-4 to 1e-10).
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
    const double size = N_VWrmsNorm(change, weights), before = std::exchange(before_, size);
    if (iteration > 0) {
      using namespace thresholds;
      if (size > slowest_ratio * before && size > judged_change * tolerance)
        return SUN_NLS_CONV_RECVR;
      ratio_ = std::max(ratio_memory * ratio_, std::min(size / before, slowest_ratio));
    }
    return test_(solver, y, change, tolerance * share(), weights, data_);
  }
  double share() const {
    const double fast = thresholds::fast_ratio;
    return ratio_ <= fast ? 1.0 : std::pow(fast / ratio_, 3) * (1.0 - ratio_);
  }

  SUNNonlinSolConvTestFn test_ = nullptr;  // CVODE's own
  void* data_ = nullptr;
  double ratio_ = 0.0;   // q
  double before_ = 0.0;  // the change before, in tolerances
};

}  // namespace saltus::sun
