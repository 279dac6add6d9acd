// Scene: a system with everything that a run of it needs, and its known answer.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saltus/report/exact.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

/// A quantity that is constant along the true solution. `value(t, row)` takes one row of the
/// recorded signals, concatenated; its drift is max |value - value at the start|.
struct Invariant {
  std::string name;  ///< "energy"
  std::function<double(double t, const Eigen::VectorXd& row)> value;
};

struct Scene {
  std::string name;
  std::shared_ptr<const System> system;
  Context context;
  TimeSpan span;
  SimulatorOptions options = {};  ///< with recorded_signals in the order of Exact::state
  Exact exact = {};
  std::vector<Invariant> invariants = {};
  /// The distance of one row to the surface that the trajectory must not pass; the penetration
  /// depth is max(-gap). Empty: no surface.
  std::function<double(double t, const Eigen::VectorXd& row)> gap = {};
  /// The methods that suit the scene.
  std::vector<Method> methods = {Method::dopri5, Method::dop853, Method::adams,
                                 Method::bdf,    Method::radau,  Method::automatic};
  double growth = 1.0;  ///< the factor by which the problem enlarges earlier errors; >= 1
  /// Makes the system anew, for the time of a cold run. Empty: a cold run begins with `system`.
  std::function<std::shared_ptr<const System>()> build = {};
};

/// The scene by a method at this rtol, with the ratio of its own atol to its own rtol.
inline Scene at_tolerance(Scene scene, Method method, double rtol) {
  scene.options.atol *= rtol / scene.options.rtol;
  scene.options.rtol = rtol;
  scene.options.ode_solver_method = method;
  return scene;
}

/// Runs a scene with its own options.
inline Results simulate(const Scene& scene) {
  return simulate(*scene.system, scene.context, scene.span, scene.options);
}

}  // namespace saltus
