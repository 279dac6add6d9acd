// TangentTimes: the derivatives of the times at which events happen.
#pragma once

#include <functional>
#include <string>

#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/options.hpp"
#include "saltus/solver/detail/guard_set.hpp"

namespace saltus {

/// The derivatives of the time of an event by each parameter, or why there are none.
struct MovedTime {
  Eigen::RowVectorXd by = {};
  std::string event = {}, obstacle = {};
  std::string doubt = "the guard only grazes zero";  ///< where a derivative is NaN
};

/// Whether two times with these derivatives move apart with a parameter. The differences of called
/// functions have errors of 1e-10 (see TangentProbe), which a slow crossing amplifies. NaN: no.
bool moves_apart(double a, double b);

/// Where a function of the time and the state reaches zero, with the flow there.
struct ZeroPlace {
  double t;         ///< [s]
  const double* x;  ///< the state
  const Eigen::VectorXd& flow;
  const SimulatorOptions& options;
};

/// Whether a function with these derivatives reaches zero so slowly that it would turn back within the
/// error of its value, or does not move there. `flow` and `tangent` give the flow and the derivatives
/// of the function at a time and a state.
bool grazes(const GuardTangent& of, double speed, const ZeroPlace& at,
            const std::function<Eigen::VectorXd(double, const double*)>& flow,
            const std::function<GuardTangent(double, const double*)>& tangent);

/// With the derivatives S of the state, a guard g and the flow f before the event, the time tau of a
/// crossing moves by dtau = -(g_x S + g_p) / (g_x f + g_t). The columns may belong to a moving time
/// already; dtau is then added to its movement.
class TangentTimes {
 public:
  TangentTimes(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
               TangentFlow& flow, TangentProbe& probe)
      : machine_(&machine), guards_(&guards), options_(&options), flow_(&flow), probe_(&probe) {}

  /// The time of a guard that fires at its root, where the machine is at time t.
  MovedTime of(const Firing& firing, bool jumped, const TangentColumns& until, double t);
  /// A time event happens at a fixed time, or at a time that follows from a discrete state.
  MovedTime of(const ScheduledEvent& event, const TangentColumns& until);
  /// The time at which a guard crosses zero at (t, x); NaN where it grazes zero.
  MovedTime of_crossing(Index slot, const std::string& event, double t, const double* x,
                        const TangentColumns& until);

 private:
  MovedTime of_jump(Index slot, const std::string& event, double t, const TangentColumns& until);
  bool changes_sign(Index slot, double t, const Eigen::VectorXd& flow, double away);
  MovedTime of_residual(const GuardTangent& residual, const std::string& event,
                        const Eigen::VectorXd& flow, const TangentColumns& until) const;

  const Machine* machine_;
  const GuardSet* guards_;
  const SimulatorOptions* options_;
  TangentFlow* flow_;
  TangentProbe* probe_;
};

}  // namespace saltus
