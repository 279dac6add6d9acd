// Tangents: the events of an instant, monitors, and the sums of Zeno monitors.
#include <cmath>
#include <limits>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

void Tangents::monitor(const MonitorHit& hit, const double* x) {
  const GuardGroup& group = machine_->plan().guard((*guards_)[hit.firing.guard()].group);
  TangentColumns at = columns_;
  if (hit.t < t_) variation_->at(hit.t, at.x);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const MovedTime moved = group.is_opaque()
                              ? MovedTime{.by = Eigen::RowVectorXd::Constant(size(), none)}
                              : times_.of_crossing(hit.firing.slot, group.name, hit.t, x, at);
  for (Index k = 0; k < size(); ++k) {
    if (std::isnan(moved.by[k]) && nth(lost_, k) == 0)
      note_gap(hit.t, k, group.name, "the monitor only grazes zero, or shows a sign only");
  }
  add_event(moved.by);
}

void Tangents::add_event(const Eigen::RowVectorXd& by) {
  Sensitivities& out = results_->sensitivities;
  if (out.event_times.size() >= results_->events.size() * out.size()) return;  // none are kept
  const std::size_t number = out.event_times.size() / out.size();
  const auto found = predicted_.find(number);
  const bool enters = results_->events[number].kind == EventKind::zeno_enter;
  for (Index k = 0; k < size(); ++k) {
    if (enters && !has_cause_ && columns_.matters(k))
      lose(k, std::string(results_->events[number].name), "the block was at rest already");
    out.event_times.push_back(by[k]);
    const double predicted = found == predicted_.end() ? by[k] : found->second[k];
    out.predicted.push_back(enters ? predicted : std::numeric_limits<double>::quiet_NaN());
  }
}

void Tangents::log() {
  const std::size_t numbers = results_->events.size() * results_->sensitivities.size();
  while (results_->sensitivities.event_times.size() < numbers) add_event(instant_time_);
  predicted_.clear();
}

namespace {

Eigen::MatrixXd rows_of(std::span<const Index> states, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd rows(static_cast<Index>(states.size()), columns.cols());
  for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = columns.row(nth(states, i));
  return rows;
}

Eigen::VectorXd entries_of(std::span<const Index> states, const Eigen::VectorXd& x) {
  Eigen::VectorXd out(static_cast<Index>(states.size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = x[nth(states, i)];
  return out;
}

}  // namespace

void Tangents::fired(const void* monitor) { monitors_[monitor].fired(t_, columns_.t); }

void Tangents::remember(const void* monitor, std::span<const Index> states,
                        const Eigen::VectorXd& next) {
  monitors_[monitor].remember(entries_of(states, next), rows_of(states, next_x_));
}

void Tangents::accumulate(const void* monitor, std::span<const Index> states,
                          const Eigen::VectorXd& next) {
  const ZenoTangent& zeno = monitors_[monitor];
  if (!zeno.knows()) return lose_accumulation();
  const Eigen::MatrixXd rest = zeno.accumulate(entries_of(states, next), rows_of(states, next_x_));
  for (Index i = 0; i < rest.rows(); ++i) next_x_.row(nth(states, i)) = rest.row(i);
  predicted_[results_->events.size()] = zeno.accumulation_time();
}

void Tangents::lose_accumulation() {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Eigen::RowVectorXd time = Eigen::RowVectorXd::Zero(size());
  for (Index k = 0; k < size(); ++k) {
    if (!columns_.matters(k)) continue;
    time[k] = none, next_x_.col(k).setConstant(none), next_z_.col(k).setConstant(none);
    lose(k, cause_, "the run began between the last events before the rest; begin it earlier");
  }
  predicted_[results_->events.size()] = time;
}

}  // namespace saltus
