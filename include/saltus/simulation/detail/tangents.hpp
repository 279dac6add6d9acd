// Tangents: the derivatives of a run, carried along beside it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/simulation/detail/computed_derivatives.hpp"
#include "saltus/simulation/detail/flow_jumps.hpp"
#include "saltus/simulation/detail/inputs_before.hpp"
#include "saltus/simulation/detail/integration.hpp"
#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/detail/stage_tangents.hpp"
#include "saltus/simulation/detail/tangent_events.hpp"
#include "saltus/simulation/detail/tangent_rows.hpp"
#include "saltus/simulation/detail/tangent_times.hpp"
#include "saltus/simulation/detail/tangent_waits.hpp"
#include "saltus/simulation/detail/transition.hpp"
#include "saltus/simulation/detail/variation.hpp"

namespace saltus {

struct SensitivityEntry;

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
class Tangents {
 public:
  /// Throws ModelError for a plan with a part that has no derivatives here.
  Tangents(const Machine& machine, const GuardSet& guards, const SimulatorOptions& options,
           Results& results);

  /// Throws ModelError for a name that is unknown, or that has no derivative.
  void require_fits(const Context& start) const;
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
  void begin_pass() { next_x_ = columns_.x, next_z_ = columns_.z; }
  /// A reset map or an update, or that of a delivery, is about to be called.
  void call(const Transition::Call& call, const Transition::Seen& seen);
  void deliver(const Transition::Arrival& arrival, const Transition::Seen& seen);
  void commit();
  /// These guards fire in the next pass.
  void look_at_firings(const Present& present);
  /// The machine has evaluated its held signals.
  void evaluated();
  void close();
  /// The events of the instant are in the log.
  void log() { events_.log(t_, cause_.has_value()); }

  // --- what waits, by its number in its queue
  void wait(std::int64_t number);
  void schedule(const PendingExecution& one, const Transition::Call& call, const NumberOf* delay,
                const Transition::Seen& seen);
  void cancel(std::int64_t number);
  void take_delivery(std::int64_t number, const std::string& event);
  void take_execution(std::int64_t number, const std::string& event);
  void write_frozen(const PendingExecution& one);
  /// The priority of an execution; null: it has none.
  struct PriorityOf {
    const NumberOf* priority;
    int leaf;
    Index entry;
    std::string event;
  };
  void tie(const std::vector<PriorityOf>& all);

  // --- a Zeno monitor, by any pointer that belongs to it alone
  void fired(const void* monitor) { events_.fired(monitor, t_); }
  void remember(const void* monitor, std::span<const Index> states, const Eigen::VectorXd& next) {
    events_.remember(monitor, states, next, next_x_);
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
  bool in_instant() const { return phase_ != Phase::between; }
  std::string cause() const { return cause_.value_or(""); }
  std::vector<ParameterDirection> directions_of(const std::vector<SensitivityEntry>& all,
                                                const Context& start);
  void begin_signals(const Context& start);
  void clear_truths();
  /// The probe is moved by `shift` along a column.
  struct MovedAlong {
    Machine* probe;
    Index column;
    double shift;
  };
  using OnSeen = std::function<void(const MovedAlong& by, At& at, double* to)>;
  Eigen::MatrixXd of_seen(const Transition::Seen& seen, Index rows, const OnSeen& function);
  Eigen::MatrixXd of_call(const Transition::Call& call, const Transition::Seen& seen);
  Eigen::MatrixXd of_declared(const Transition::Call& call, const Transition::Seen& seen,
                              const DerivativesFunction& derivatives);
  Eigen::RowVectorXd of_number(const NumberOf& number, const Transition::Seen& seen);
  Eigen::RowVectorXd of_priority(const PriorityOf& one);
  void write(const PlanLeaf& leaf, const Eigen::MatrixXd& by);
  void look_at_unchanged(const std::vector<int>& changed, const Eigen::MatrixXd& by,
                         const Eigen::MatrixXd& before, const Transition::Call& call);
  TangentWaits::Waiting take(const WaitingKey& key, const std::string& event);
  void merge(const MovedTime& moved, bool first);
  void look_beside(const Present& present, const TangentColumns& until, const Eigen::VectorXd& flow,
                   bool first);
  void look_beside(std::size_t guard, double g, const TangentColumns& until,
                   const Eigen::VectorXd& flow);
  void look_at_kinks();
  bool bends_soon(Index k, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
  double rounding_of(const GuardTangent& guard, const Eigen::VectorXd& flow) const;
  void look_at_waiting();
  void look_at_waiting(std::size_t guard, const Eigen::VectorXd& flow);
  bool decides(const GuardGroup& group, Index entry, const Eigen::VectorXd& flow);
  bool bends(const GuardGroup& group, Index entry, Index k);
  Eigen::VectorXd flow_with_truth(const GuardGroup& group, Index entry, bool other, Index k,
                                  double shift);
  /// Dense output begins here.
  void open_trajectory();
  void lose(Index k, const std::string& event, const std::string& reason) {
    gaps_.lose(t_, k, event, reason);
  }
  void solve(double from, double to, Integration& integration);
  void collocate(double from, double to, Integration& integration, Eigen::MatrixXd& s);
  /// S at a time within the last step; as it is if there was none.
  void inside(double t, Eigen::MatrixXd& s);
  void need_inside();
  void look_for_jump(double from, double to, const FlowJumps::StateAt& state);

  const Machine* machine_;
  const GuardSet* guards_;
  const SimulatorOptions* options_;
  Results* results_;
  ComputedDerivatives computed_;
  TangentProbe probe_;
  TangentFlow flow_;
  FlowJumps jumps_;
  TangentTimes times_;
  StageTangents stages_;
  std::optional<Variation> variation_;
  TangentColumns columns_;  // of the state between instants, then of the instant
  TangentColumns before_;   // at a fixed time before the instant
  InputsBefore inputs_before_;
  TangentWaits waits_;
  Eigen::VectorXd guard_sizes_;  // the largest value of each so far
  TangentWaits::Waiting taken_;  // the execution of this pass
  OneSided one_sided_;
  TangentGaps gaps_;
  TangentEvents events_;
  TangentRows rows_;
  std::optional<std::string> cause_;  // of the last instant: the name of an event
  Eigen::MatrixXd next_x_, next_z_;
  double t_ = 0.0;  // [s] of S, or of the instant
  Phase phase_ = Phase::between;
};

}  // namespace saltus
