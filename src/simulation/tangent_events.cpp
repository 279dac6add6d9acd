#include "saltus/simulation/detail/tangent_events.hpp"

#include <string>

namespace saltus {

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

void TangentEvents::add(double t, const Eigen::RowVectorXd& by, bool has_cause) {
  Sensitivities& out = results_->sensitivities;
  if (out.event_times.size() >= results_->events.size() * out.size()) return;  // none are kept
  const std::size_t number = out.event_times.size() / out.size();
  const auto found = predicted_.find(number);
  const bool enters = results_->events[number].kind == EventKind::zeno_enter;
  for (Index k = 0; k < columns_->size(); ++k) {
    if (enters && !has_cause && columns_->matters(k))
      gaps_->lose(t, k, std::string(results_->events[number].name),
                  "the block was at rest already");
    out.event_times.push_back(by[k]);
    const double predicted = found == predicted_.end() ? by[k] : found->second[k];
    out.predicted.push_back(enters ? predicted : TangentGaps::none);
  }
}

void TangentEvents::log(double t, bool has_cause) {
  const std::size_t numbers = results_->events.size() * results_->sensitivities.size();
  while (results_->sensitivities.event_times.size() < numbers) add(t, instant_time_, has_cause);
  predicted_.clear();
}

void TangentEvents::finish() {
  Sensitivities& out = results_->sensitivities;
  const std::size_t numbers = results_->events.size() * out.size();
  out.event_times.resize(numbers), out.predicted.resize(numbers);
}

void TangentEvents::remember(const void* monitor, std::span<const Index> states,
                             const Eigen::VectorXd& next, const Eigen::MatrixXd& derivatives) {
  monitors_[monitor].remember(entries_of(states, next), rows_of(states, derivatives));
}

bool TangentEvents::accumulate(const void* monitor, std::span<const Index> states,
                               const Eigen::VectorXd& next, Eigen::MatrixXd& derivatives) {
  const ZenoTangent& zeno = monitors_[monitor];
  const std::size_t number = results_->events.size();
  if (!zeno.knows()) {
    predicted_[number] = unknown_time();
    return false;
  }
  const Eigen::MatrixXd rest =
      zeno.accumulate(entries_of(states, next), rows_of(states, derivatives));
  for (Index i = 0; i < rest.rows(); ++i) derivatives.row(nth(states, i)) = rest.row(i);
  predicted_[number] = zeno.accumulation_time();
  return true;
}

Eigen::RowVectorXd TangentEvents::unknown_time() const {
  Eigen::RowVectorXd time = Eigen::RowVectorXd::Zero(columns_->size());
  for (Index k = 0; k < columns_->size(); ++k)
    if (columns_->matters(k)) time[k] = TangentGaps::none;
  return time;
}

}  // namespace saltus
