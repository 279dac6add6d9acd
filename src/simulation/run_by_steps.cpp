// RunBySteps: steps that count once it is known what arrives in them.
#include "saltus/simulation/detail/run_by_steps.hpp"

#include <algorithm>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/simulation/detail/guarded.hpp"

namespace saltus {

void RunBySteps::begin_piece(double t_end) {
  require_ready(t_end);
  endings_.go_on(std::chrono::steady_clock::now());
  t_end_ = t_end, taken_.reset();
  guarded([&] {
    if (over_) return results_.status;
    if (!begun_) {
      if (const Status status = begin(t_end); over_) return status;
    }
    return take_step();
  });
}

double RunBySteps::next() const noexcept {
  if (!taken_ || over()) return std::numeric_limits<double>::infinity();
  return taken_->failed ? time_ : std::min(taken_->to, instant_.queues().next_outside());
}

/// Takes the next step, if there is one. One that fails may have failed beyond what arrives.
Status RunBySteps::take_step() {
  taken_.reset();
  if (time_ >= t_end_) return Status::reached_end;
  if (const auto status = over_steps(t_end_)) return *status;
  depart(time_);
  Taken step{.to = time_, .reason = StopReason::step, .t_stop = next_stop(t_end_)};
  try {
    const double due = instant_.queues().next_outside();
    step.reason = integration_.advance_recallably(step.to, step.t_stop, due);
  } catch (const Interruption&) {
    throw;
  } catch (...) {
    detail::pass_end_of_thread();
    step.failed = true;
  }
  taken_ = step;
  return Status::reached_end;
}

void RunBySteps::run_window(double safe, double latest) {
  const auto start = std::chrono::steady_clock::now();
  while (next() <= latest && Calendar::is_clearly_before(next(), safe)) commit(safe);
  results_.statistics.wall_time +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The step that was taken counts, and so does the instant at its end, if there is one. Takes the
/// next step.
void RunBySteps::commit(double safe) {
  guarded([&] { return commit_step(safe); });
}

Status RunBySteps::commit_step(double safe) {
  const double from = time_, due = instant_.queues().next_outside();
  double to = taken_->to;
  const StopReason reason = taken_->failed
                                ? step_again(to, std::min({taken_->t_stop, due, safe, t_end_}))
                                : integration_.cut(to, taken_->reason, std::min(due, t_end_));
  time_ = to;
  if (const Status status = arrive(from, reason, t_end_, arrives_by(to)); over_) return status;
  return take_step();
}

/// Takes the step anew, no further than to t_stop [s]: nothing arrives before.
StopReason RunBySteps::step_again(double& to, double t_stop) {
  integration_.take_state(time_);
  integration_.restart(time_, {});
  return integration_.advance(to, t_stop);
}

void RunBySteps::cut_at(double t) {
  t_end_ = t;
  if (taken_ && !taken_->failed && !(time_ < t))
    integration_.cut(taken_->to, taken_->reason, time_);
  if (!(time_ < t)) taken_.reset();
  while (taken_ && !over()) commit(t);
}

}  // namespace saltus
