// Setting up CVODE: the tolerances it works with, its vectors, and its limits.
#pragma once

#include <algorithm>
#include <cmath>

#include "cvode_scene.hpp"
#include "saltus/solver/detail/cvode.hpp"
#include "saltus/solver/detail/cvode_thresholds.hpp"
#include "small_vector.hpp"
#include "sundials_compat.hpp"

namespace saltus {

/// Whether a method gets a smaller part of the tolerance: see thresholds::loose_rtol.
inline bool is_loose(CvodeMethod method, const SolverOptions& options) {
  return method == CvodeMethod::bdf && options.rtol >= thresholds::loose_rtol;
}

/// The tolerances that CVODE gets.
inline SolverOptions tolerances_for(CvodeMethod method, SolverOptions options) {
  if (!is_loose(method, options)) return options;
  options.rtol *= thresholds::loose_share, options.atol *= thresholds::loose_share;
  for (auto* each : {&options.rtols, &options.atols})
    for (double& tolerance : *each) tolerance *= thresholds::loose_share;
  return options;
}

inline N_Vector make_vector(Index n, SUNContext context) {
  N_Vector vector = N_VNew_Serial(static_cast<sunindextype>(n), context);
  if (vector == nullptr) throw Error("SUNDIALS: out of memory");
  sun::use_small_operations(vector);
  return vector;
}

/// CVODE's own weights for one rtol and one atol for all states or one for each; a weight function
/// where rtol differs from state to state.
inline void set_tolerances(void* cvode, N_Vector like, CvodeScene& scene, const SolverOptions& by) {
  if (by.rtols.empty()) {
    CVodeSStolerances(cvode, by.rtol, by.atol);
  } else if (std::ranges::all_of(by.rtols, [&](double r) { return r == by.rtol; })) {
    const sun::Vector atol(N_VClone(like));
    if (!atol) throw Error("SUNDIALS: out of memory");
    std::ranges::copy(by.atols, N_VGetArrayPointer(atol.get()));
    CVodeSVtolerances(cvode, by.rtol, atol.get());  // CVODE copies it
  } else {
    scene.weigh_by(by);
    CVodeWFtolerances(cvode, CvodeScene::weights);
  }
}

inline void set_limits(void* cvode, const SolverOptions& options) {
  CVodeSetMaxHnilWarns(cvode, -1);
  CVodeSetMaxConvFails(cvode, thresholds::convergence_failures);
  if (options.min_step > 0.0) CVodeSetMinStep(cvode, options.min_step);
  if (std::isfinite(options.max_step)) CVodeSetMaxStep(cvode, options.max_step);
}

}  // namespace saltus
