// TangentEvents: the derivatives of the times of the logged events, and of Zeno times.
#pragma once

#include <map>
#include <span>
#include <utility>

#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "saltus/simulation/detail/zeno_tangent.hpp"

namespace saltus {

/// Writes `Sensitivities::event_times` and `predicted`, a row for each event of the log. A Zeno
/// monitor is known here by any pointer that belongs to it alone.
class TangentEvents {
 public:
  TangentEvents(const TangentColumns& columns, TangentGaps& gaps, Results& results)
      : columns_(&columns), gaps_(&gaps), results_(&results) {}

  void begin() { monitors_.clear(), predicted_.clear(); }

  /// Adds the derivatives of the time of the next event, at t [s]. An entry into rest needs a cause:
  /// without one the block was at rest already, and no derivative exists.
  void add(double t, const Eigen::RowVectorXd& by, bool has_cause);
  /// An instant, whose time has these derivatives, is over.
  void close(Eigen::RowVectorXd by) { instant_time_ = std::move(by); }
  /// Adds those of all events of the last instant, at t, that are in the log by now.
  void log(double t, bool has_cause);
  /// A failure takes events back.
  void finish();

  /// The guard of a monitor fires at t.
  void fired(const void* monitor, double t) { monitors_[monitor].fired(t, columns_->t); }
  /// Some states after the firing, of all next states with their derivatives.
  void remember(const void* monitor, std::span<const Index> states, const Eigen::VectorXd& next,
                const Eigen::MatrixXd& derivatives);
  /// Writes the derivatives of the accumulation state. False if they are not known.
  bool accumulate(const void* monitor, std::span<const Index> states, const Eigen::VectorXd& next,
                  Eigen::MatrixXd& derivatives);

 private:
  Eigen::RowVectorXd unknown_time() const;

  const TangentColumns* columns_;
  TangentGaps* gaps_;
  Results* results_;
  Eigen::RowVectorXd instant_time_;  // the derivatives of the time of the last instant
  std::map<const void*, ZenoTangent> monitors_;
  std::map<std::size_t, Eigen::RowVectorXd> predicted_;  // of the events with these numbers
};

}  // namespace saltus
