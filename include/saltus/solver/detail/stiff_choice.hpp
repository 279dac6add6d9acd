// Which method advances a stiff scene: Radau or BDF.
#pragma once

#include "saltus/solver/detail/matrix_cost.hpp"
#include "saltus/solver/detail/stiff_thresholds.hpp"

namespace saltus {

/// The facts on which the choice depends.
struct StiffScene {
  double states = 0.0;
  double rtol = 1e-6;          ///< the smallest
  bool hardly_damped = false;  ///< the fastest part oscillates: see SpectralRadius::damping
  bool many_events = false;    ///< they end the stretches of BDF before its order has risen
};

enum class StiffMethod { none, radau, bdf };

struct StiffChoice {
  StiffMethod method = StiffMethod::none;
  const char* why = "";  ///< in a sentence that begins with "the scene looks stiff"
};

/// Chooses the method. `cost` returns the MatrixCost; it is called only where the choice depends on
/// it, because it has to look for the sparsity.
///
/// The figures are those of whole runs by both methods on the stiff scenes of the shelf, and on
/// chains and full systems of 4 to 4 000 states, at rtol 1e-3 to 1e-12. At the same rtol Radau
/// takes 1.5 to 3 times the calls and a third to a twentieth of the steps, and its errors are ten
/// to a hundred times smaller. A step of BDF costs more than its calls where there are few states.
/// There Radau takes less time: 0.6 to 1.2 of it at 3 to 20 states. With more states calls and
/// matrices are all of the cost, and BDF takes 0.5 to 0.7 of the time. But at tight tolerances
/// BDF's errors are ten to a thousand tolerances. Radau's complex matrices cost up to thirteen
/// times a real one and are new in nearly each step: where matrices are expensive, it is too slow
/// even then.
///
/// BDF of orders 3 to 5 is unstable near the imaginary axis (Hairer, Wanner II, p. 251), so
/// a scene that is hardly damped stays with the explicit method where Radau is not possible.
template <class Cost>
StiffChoice choose_stiff_method(const StiffScene& scene, const Cost& cost) {
  using namespace thresholds;
  const bool few = scene.states <= few_for_radau;
  const bool tight = scene.rtol <= tight_for_bdf;
  if (!few && !tight && !scene.hardly_damped && !scene.many_events)
    return {StiffMethod::bdf, "and has many states"};
  const MatrixCost matrices = cost();
  if (scene.hardly_damped) {
    if (!matrices.direct) return {};
    return {StiffMethod::radau, "beside a fast oscillation that is hardly damped"};
  }
  if (!matrices.direct) return {StiffMethod::bdf, "and its matrices would fill up"};
  if (few) return {StiffMethod::radau, "and has few states"};
  if (matrices.time > dear_matrices * scene.states)
    return {StiffMethod::bdf, "and its matrices are expensive"};
  return {StiffMethod::radau, tight ? "and the tolerance is tight" : "and events are frequent"};
}

}  // namespace saltus
