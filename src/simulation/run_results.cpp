// The results of a run: dense output, the final context, counts.
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

/// Completes the results: context, last row and counts.
void Run::finish() {
  const bool at_instant =
      results_.status == Status::terminal || results_.status == Status::zeno_stop;
  const bool whole = results_.status != Status::failed;
  if (!at_instant && whole) integration_.take_state(time_);
  if (whole) rows_.record(time_, instant_.jump(), machine_.x.data());
  if (options_.dense_output) results_.trajectory.close(time_, machine_, instant_.contacts(), whole);
  results_.context = context();
  if (tangents_) tangents_->finish();
  Statistics& s = results_.statistics;
  integration_.report(s);
  count_calls();
  s.events_by_name = instant_.journal().counts();
}

Context Run::context() const {
  if (!begun_) return begin_;
  if (results_.status == Status::failed && accepted_.place == Place::start) return begin_;
  const bool settled = results_.status != Status::failed || accepted_.settled;
  return machine_.save(begin_, time_, std::make_shared<const Continuation>(instant_.save()),
                       settled, instant_.queues().pending());
}

std::string Run::describe() const {
  return plan().describe() + integration_.describe() + (tangents_ ? tangents_->describe() : "");
}

Results Run::take_results() {
  EventLog next = results_.events.emptied();
  Results taken = std::move(results_);
  results_.events = std::move(next);
  rows_.renew();
  if (tangents_) tangents_->renew();
  if (options_.dense_output && begun_) {
    results_.trajectory.start(machine_.shared_plan(), begin_, options_);
    results_.trajectory.open(time_, machine_, instant_.contacts());
  }
  return taken;
}

}  // namespace saltus
