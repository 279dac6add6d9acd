// WaitingTangents: what an instant leaves for later, and what an earlier one left.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saltus/simulation/detail/pass_tangents.hpp"
#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/simulation/detail/tangent_waits.hpp"

namespace saltus {

/// Follows the queues of deliveries and executions, in which each has its number. It keeps the
/// derivatives of what waits, and loses those for which the order in the queues would change.
class WaitingTangents {
 public:
  WaitingTangents(const Machine& machine, const TangentColumns& columns, PassTangents& pass,
                  TangentGaps& gaps)
      : machine_(&machine), columns_(&columns), pass_(&pass), gaps_(&gaps) {}

  /// A run begins: what waits has fixed times and values.
  void begin() { waits_.begin(columns_->size()); }
  /// The derivatives of the time at which something is due.
  const Eigen::RowVectorXd& time_of(const WaitingKey& key) const { return waits_.time_of(key); }

  /// A delivery waits: its delay is a constant.
  void wait(std::int64_t number);
  /// An execution waits. Its delay is a number or a function; null: it has none.
  void schedule(const PendingExecution& one, const Transition::Call& call, const NumberOf* delay,
                const Transition::Seen& seen);
  void cancel(std::int64_t number);
  void take_delivery(std::int64_t number, const std::string& event);
  void take_execution(std::int64_t number, const std::string& event);
  /// The execution that was taken writes values of its trigger.
  void write_frozen(const PendingExecution& one);
  /// Several executions are due at one time with one priority, so their numbers, or a draw, decide.
  void tie(const std::vector<PriorityOf>& all);

 private:
  void look_at_unchanged(const std::vector<int>& changed, const Eigen::MatrixXd& by,
                         const Eigen::MatrixXd& before, const Transition::Call& call);
  TangentWaits::Waiting take(const WaitingKey& key, const std::string& event);
  void lose(Index k, const std::string& event, const std::string& reason) {
    gaps_->lose(pass_->called().time(), k, event, reason);
  }

  const Machine* machine_;
  const TangentColumns* columns_;
  PassTangents* pass_;
  TangentGaps* gaps_;
  TangentWaits waits_;
  TangentWaits::Waiting taken_;  // the execution of this pass
};

}  // namespace saltus
