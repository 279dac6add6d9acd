// Tangents: the derivatives of a run, carried along beside it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "saltus/simulation/detail/dense_tangents.hpp"
#include "saltus/simulation/detail/guards_at_zero.hpp"
#include "saltus/simulation/detail/held_tangents.hpp"
#include "saltus/simulation/detail/instant_time.hpp"
#include "saltus/simulation/detail/pass_tangents.hpp"
#include "saltus/simulation/detail/resting_kinks.hpp"
#include "saltus/simulation/detail/step_tangents.hpp"
#include "saltus/simulation/detail/tangent_events.hpp"
#include "saltus/simulation/detail/tangent_rows.hpp"
#include "saltus/simulation/detail/tangent_start.hpp"
#include "saltus/simulation/detail/waiting_tangents.hpp"

namespace saltus {

/// Watches a run and never changes it. Between instants it solves the linear equation S' = f_x S +
/// f_p along the steps of the run. At an instant whose time tau depends on a parameter it goes over
/// to the total derivatives X = S + f- dtau, which belong to the moving instant. Every function that
/// the instant calls maps them on, in the order of the passes. At its end S = X - f+ dtau holds for
/// a fixed time again. This is the saltation rule in all its cases: parameters in guard and reset,
/// modes, several resets in one pass, cascades of passes.
///
/// A flow that does not depend on the time has one more form: X obeys the equation of S from there
/// on, as the derivative at a fixed time after the instant. It is kept as long as possible, because
/// S loses digits where dtau is large: after 140 bounces dtau is 3e8 times the length of a flight.
///
/// This class owns the columns and the order of the phases. Its parts read the columns. A step, the
/// causes of an instant and a lost derivative are written by StepTangents, InstantTime and
/// TangentGaps.
class Tangents {
 public:
  /// Throws ModelError for a plan with a part that has no derivatives here.
  Tangents(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
           Results& results);
  Tangents(const Tangents&) = delete;  // its parts read its columns

  /// Throws ModelError for a name that is unknown, or that has no derivative.
  void require_fits(const Context& start) const { start_.require_fits(start); }
  /// A run begins at these values; the machine has them, and its held signals, already.
  void begin(const Context& start);
  /// The results were moved out: what is to come is of new ones.
  void renew();

  /// A step was accepted.
  void step(double from, double to, Integration& integration);
  /// A monitor crossed inside the last step, at the state x.
  void monitor(const MonitorHit& hit, const double* x);

  // --- an instant
  void open(const Present& present, const std::vector<int>& due,
            const std::vector<DueNow>& waiting);
  void begin_pass() { pass_.begin(); }
  /// A reset map or an update, or that of a delivery, is about to be called.
  void call(const Transition::Call& call, const Transition::Seen& seen) { pass_.call(call, seen); }
  void deliver(const Transition::Arrival& arrival, const Transition::Seen& seen) {
    pass_.call(arrival, seen);
  }
  void commit();
  /// These guards fire in the next pass.
  void look_at_firings(const Present& present) { at_zero_.look_at_firings(present); }
  /// The machine has evaluated its held signals.
  void evaluated();
  void close();
  /// The events of the instant are in the log.
  void log() { events_.log(t_, time_.cause().has_value()); }
  /// What waits, by its number in its queue.
  WaitingTangents& waiting() noexcept { return waiting_; }

  // --- a Zeno monitor, by any pointer that belongs to it alone
  void fired(const void* monitor) { events_.fired(monitor, t_); }
  void remember(const void* monitor, std::span<const Index> states, const Eigen::VectorXd& next) {
    events_.remember(monitor, states, next, pass_.next().x);
  }
  void accumulate(const void* monitor, std::span<const Index> states, const Eigen::VectorXd& next);

  // --- rows
  void record(double t, const double* x);
  void drop() { rows_.drop(); }

  /// The run ends at t.
  void finish();
  std::string describe() const;

 private:
  enum class Phase { between, opened, committed };  // of the present instant, if there is one

  Index size() const { return columns_.size(); }
  void take_causes(const Present& present, const std::vector<int>& due,
                   const std::vector<DueNow>& waiting, const Eigen::VectorXd& flow);

  AtJump at_jump(double t, const double* x, const TangentColumns& at);
  void lose_beside_jump(const TangentColumns& before, const std::string& event,
                        const std::string& reason);

  const Machine* machine_;
  const GuardSet* guards_;
  TangentStart start_;
  TangentProbe probe_;
  TangentFlow flow_;
  TangentTimes times_;
  TangentColumns columns_;  // of the state between instants, then of the instant
  TangentGaps gaps_;
  FlowSwitches switches_;
  StepTangents steps_;
  InstantTime time_;
  HeldTangents held_;
  PassTangents pass_;
  WaitingTangents waiting_;
  GuardsAtZero at_zero_;
  RestingKinks kinks_;
  OneSided one_sided_;
  TangentEvents events_;
  TangentRows rows_;
  DenseTangents dense_;
  double t_ = 0.0;  // [s] of S, or of the instant
  Phase phase_ = Phase::between;
};

}  // namespace saltus
