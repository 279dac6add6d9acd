// RunLoop: the loop from instant to instant.
#include "saltus/simulation/detail/run_loop.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

RunLoop::RunLoop(std::shared_ptr<const Plan> plan, SimulatorOptions options)
    : options_(std::move(options)),
      machine_(std::move(plan)),
      guards_(machine_.plan()),
      instant_(machine_, guards_, options_, results_),
      calendar_(machine_.plan(), &machine_.z, instant_.queues().next_due()),
      major_(options_.max_major_step_length),
      integration_(machine_, guards_, options_),
      rows_(machine_, results_, options_),
      histories_(machine_, options_),
      endings_(machine_, options_) {
  if (options_.sensitivity.empty()) return;
  tangents_.emplace(machine_, guards_, options_, results_);
  instant_.follow(&*tangents_), rows_.follow(&*tangents_);
}

Status RunLoop::run_to(double t_end) {
  if (over_) return results_.status;
  if (!begun_) {
    if (const Status status = begin(t_end); over_) return status;
  }
  while (time_ < t_end) {
    if (const auto status = over_steps(t_end)) return *status;
    if (const Status status = step(t_end); over_) return status;
    if (auto ending = endings_.interrupted(time_, [this] { count_calls(); })) return end(*ending);
  }
  return Status::reached_end;
}

/// Runs the instant at which the run starts, unless an earlier run has settled it.
Status RunLoop::begin(double t_end) {
  begun_ = true;
  const Continuation* earlier = begin_.continuation();
  const bool resumes = earlier != nullptr && instant_.fits(*earlier);
  histories_.begin(resumes);
  resumes ? instant_.resume(time_, rows_.recorder(), *earlier, t_end - time_)
          : instant_.begin(time_, rows_.recorder());
  if (tangents_) tangents_->begin(begin_);
  rows_.record(time_, instant_.jump(), machine_.x.data());
  if (options_.dense_output) results_.trajectory.open(time_, machine_, instant_.contacts());
  if (!resumes) return settle(StopReason::stop_time, t_end, true);
  // A run that failed in an instant goes on with that instant.
  const bool roots = instant_.stops().finds_roots();
  if (roots || calendar_.due(time_) || arrives_by(time_))
    return settle(roots ? StopReason::root : StopReason::stop_time, t_end, false);
  accepted_.place = Place::machine;
  major_.begin(time_);
  return Status::reached_end;
}

std::optional<Status> RunLoop::over_steps(double t_end) {
  if (!options_.max_major_steps || results_.statistics.instants < *options_.max_major_steps)
    return {};
  return end({.status = Status::step_limit,
              .message = text("t = ", time_, " s: the run used its ", *options_.max_major_steps,
                              " major steps before t = ", t_end, " s; raise max_major_steps")});
}

/// Takes one minor step, and runs the instant at its end if there is one.
Status RunLoop::step(double t_end) {
  const double from = time_;
  const double t_stop = next_stop(t_end);
  depart(from);
  const StopReason reason = integration_.advance(time_, t_stop);
  return arrive(from, reason, t_end, false);
}

/// [s] Where the next step stops at the latest.
double RunLoop::next_stop(double t_end) {
  return major_.next(time_, std::min(t_end, calendar_.stop(histories_.longest_end(time_))));
}

/// A step leaves the time `from`.
void RunLoop::depart(double from) {
  if (options_.dense_output) results_.trajectory.depart(integration_.state());
  endings_.depart(from, integration_.state());
}

/// A step from `from` ends at time_. `arrives`: deliveries of other islands are due there.
Status RunLoop::arrive(double from, StopReason reason, double t_end, bool arrives) {
  if (reason == StopReason::root) finish_at_event(from, t_end);
  if (endings_.passed_pole(from, time_, integration_)) fail_at_pole(from);
  accept(from);
  if (auto ending = endings_.after_step(time_, t_end - begin_.time(), integration_))
    return end(*ending);
  if (reason == StopReason::step && !arrives) return Status::reached_end;
  return settle(reason, t_end, false);
}

/// Runs the instant at time_, if there is one.
Status RunLoop::settle(StopReason reason, double t_end, bool at_start) {
  integration_.take_state(time_);
  if (accepted_.place == Place::solver) accepted_.place = Place::machine;
  ++results_.statistics.instants;
  results_.trajectory.instant();
  if (!instant_begins(reason, t_end, at_start)) return Status::reached_end;
  major_.begin(time_);
  rows_.record(time_, instant_.jump(), machine_.x.data());  // the row that a failure leaves
  accepted_.rows = results_.time.size();
  const bool at_root = reason == StopReason::root;
  const bool idle = (at_root || instant_.queues().may_wait()) && endings_.idle();
  const Outcome outcome = run_instant(t_end, at_start);
  const Chattering::Seen seen{time_, at_root, t_end - begin_.time(), instant_.queues().set_off()};
  if (auto ending = endings_.after_instant(outcome, seen, idle, instant_.journal()))
    return end(*ending);
  return Status::reached_end;
}

/// Whether the stop is more than the end of a major step. Takes the time events that are due, and finds the
/// guards that fire there but for rounding.
bool RunLoop::instant_begins(StopReason& reason, double t_end, bool at_start) {
  due_.clear();
  const bool due = calendar_.due(time_) || arrives_by(time_);
  if (!at_start && (due || time_ >= t_end) && instant_.stops().meets(time_, t_end - time_))
    reason = StopReason::root;
  if (due || at_start) calendar_.take(time_, due_);
  return reason == StopReason::root || due || at_start;
}

/// Restarts the solver after the instant if its history is not valid any more.
Outcome RunLoop::run_instant(double t_end, bool at_start) {
  accepted_.in_instant = true;
  const int jump = instant_.jump();
  const Outcome outcome = instant_.run(time_, due_, t_end - time_, at_start);
  if (tangents_) tangents_->log();
  if (instant_.jump() != jump) histories_.changed();
  accepted_ = {.place = Place::machine, .settled = true};
  const bool cut = instant_.queues().stops_earlier() && integration_.inside_step();
  if (std::exchange(behind_event_, false) || outcome.restart || cut)
    integration_.restart(time_, {.horizon = outcome.horizon, .flow = instant_.flow()});
  return outcome;
}

Status RunLoop::end(Endings::Ending ending) {
  over_ = true;
  results_.status = ending.status;
  results_.message = std::move(ending.message);
  if (!ending.block.empty()) results_.block = std::move(ending.block);
  return ending.status;
}

void RunLoop::count_calls() {
  Statistics& s = results_.statistics;
  s.right_hand_side_calls = machine_.rhs_calls;
  s.guard_calls = machine_.guard_calls;
  s.jacobian_calls = machine_.jacobian_calls;
}

}  // namespace saltus
