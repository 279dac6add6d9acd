// Run: the loop from instant to instant.
#include "saltus/simulation/detail/guarded.hpp"

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/plan/detail/kept.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "width.hpp"

namespace saltus {

namespace {

SimulatorOptions checked(SimulatorOptions options) {
  detail::check(options);
  require_linear_solver(options.linear_solver, options.ode_solver_method);
  return options;
}

SimulatorOptions checked_for(const Plan& plan, SimulatorOptions options) {
  options = checked(std::move(options));
  require_widths(options, plan);
  return options;
}

void require_common_step(const Context& context) {
  if (context.continuation() == nullptr || context.continuation()->islands.empty()) return;
  throw ModelError(
      "the context ended a run whose islands stepped apart; continue it with the option "
      "islands = true, or take context.with_time(context.time()), which begins anew from its "
      "values");
}

}  // namespace

Run::Run(const System& system, SimulatorOptions options)
    : Run(compile(system, checked(options).recorded_signals, options.refinement.get()), options) {
  options_.refinement.reset();  // the plan does not need it any more
}

void Run::functions_replaced() {
  plan().series->forget();
  plan().divisors->forget();
  machine_.functions_replaced();  // first: a method that does not suit them now must not go on
  require_series(machine_.plan(), options_.ode_solver_method);
}

Run::Run(std::shared_ptr<const Plan> plan, SimulatorOptions options)
    : options_(checked_for(*plan, std::move(options))),
      machine_(std::move(plan)),
      guards_(machine_.plan()),
      instant_(machine_, guards_, options_, results_),
      calendar_(machine_.plan(), &machine_.z, instant_.next_due()),
      major_(options_.max_major_step_length),
      integration_(machine_, guards_, options_),
      rows_(machine_, results_, options_),
      histories_(machine_, options_),
      endings_(machine_, options_) {
  if (options_.sensitivity.empty()) return;
  tangents_.emplace(machine_, guards_, options_, results_);
  instant_.follow(&*tangents_), rows_.follow(&*tangents_);
}

/// A context that is refused leaves the run as it is.
void Run::initialize(const Context& context) {
  require_context_of(plan(), context);
  require_common_step(context);
  if (context.continuation() != nullptr) instant_.fits(*context.continuation());
  if (tangents_) tangents_->require_fits(context);
  instant_.require_fits(context);
  calendar_.check(context.time());
  Context last = std::exchange(begin_, {});  // no run, if a function of the model throws now
  machine_.load(context);
  last = context;  // in the memory of the last run's
  if (plan().computed) last = last.with_computed(plan().computed);
  begin_ = std::move(last);
  time_ = context.time();
  results_.time.clear(), results_.jump.clear();
  results_.statistics = {}, results_.message.clear();
  results_.block.clear(), results_.cause = nullptr, results_.status = Status::reached_end;
  rows_.begin();
  if (options_.dense_output) results_.trajectory.start(machine_.shared_plan(), begin_, options_);
  calendar_.begin(time_, context.settled());
  instant_.begin_queues(context);
  integration_.begin();
  begun_ = over_ = behind_event_ = false, taken_.reset();
  accepted_ = {.settled = context.settled()};
  endings_.begin(time_);
}

Status Run::advance_to(double t_end) {
  require_ready(t_end);
  const auto start = std::chrono::steady_clock::now();
  endings_.go_on(start);
  guarded([&] { return run_to(t_end); });
  results_.statistics.wall_time +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  finish();
  if (ended_well(results_.status) || !options_.throw_errors) return results_.status;
  const auto partial = std::make_shared<Results>(results_);
  partial->cause = nullptr;  // otherwise the error would own itself
  try {
    if (results_.cause) std::rethrow_exception(results_.cause);
    throw SimulationError(results_.message, time_, results_.block);
  } catch (SimulationError& error) {
    error.attach(partial);
    throw;
  }
}

Status Run::run_to(double t_end) {
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
Status Run::begin(double t_end) {
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
  const bool roots = instant_.finds_roots();
  if (roots || calendar_.due(time_) || arrives_by(time_))
    return settle(roots ? StopReason::root : StopReason::stop_time, t_end, false);
  accepted_.place = Place::machine;
  major_.begin(time_);
  return Status::reached_end;
}

std::optional<Status> Run::over_steps(double t_end) {
  if (!options_.max_major_steps || results_.statistics.instants < *options_.max_major_steps)
    return {};
  return end({.status = Status::step_limit,
              .message = text("t = ", time_, " s: the run used its ", *options_.max_major_steps,
                              " major steps before t = ", t_end, " s; raise max_major_steps")});
}

/// Takes one minor step, and runs the instant at its end if there is one.
Status Run::step(double t_end) {
  const double from = time_;
  const double t_stop = next_stop(t_end);
  depart(from);
  const StopReason reason = integration_.advance(time_, t_stop);
  return arrive(from, reason, t_end, false);
}

/// [s] Where the next step stops at the latest.
double Run::next_stop(double t_end) {
  return major_.next(time_, std::min(t_end, calendar_.stop(histories_.longest_end(time_))));
}

/// A step leaves the time `from`.
void Run::depart(double from) {
  if (options_.dense_output) results_.trajectory.depart(integration_.state());
  endings_.depart(from, integration_.state());
}

/// A step from `from` ends at time_. `arrives`: deliveries of other islands are due there.
Status Run::arrive(double from, StopReason reason, double t_end, bool arrives) {
  if (reason == StopReason::root) finish_at_event(from, t_end);
  if (endings_.passed_pole(from, time_, integration_)) fail_at_pole(from);
  accept(from);
  if (auto ending = endings_.after_step(time_, t_end - begin_.time(), integration_))
    return end(*ending);
  if (reason == StopReason::step && !arrives) return Status::reached_end;
  return settle(reason, t_end, false);
}

/// The step from `from` to time_ is accepted: its rows, monitors and histories are kept.
void Run::accept(double from) {
  accepted_.settled = false;
  accepted_.place = integration_.started() ? Place::solver : Place::machine;
  if (options_.dense_output) keep_step(from);
  if (tangents_) tangents_->step(from, time_, integration_);
  if (!guards_.monitors.empty()) log_monitors();
  rows_.record_step(from, time_, instant_.jump(), integration_);
  if (histories_.any()) keep_histories(from);
}

/// The trajectory needs the histories with which the next step begins.
void Run::keep_histories(double from) {
  histories_.add(from, time_, integration_);
  results_.trajectory.instant();
}

/// Logs the monitors that crossed inside the last step.
void Run::log_monitors() {
  for (const MonitorHit& hit : guards_.monitors) {
    if (instant_.judges(hit, time_, guards_.fired_at_root)) continue;
    Eigen::VectorXd& x = integration_.at(hit.t);
    machine_.put_carried(hit.t, x.data());
    instant_.log_monitor(hit, x.data());
    if (tangents_) tangents_->monitor(hit, x.data());
  }
}

/// Runs the instant at time_, if there is one.
Status Run::settle(StopReason reason, double t_end, bool at_start) {
  integration_.take_state(time_);
  if (accepted_.place == Place::solver) accepted_.place = Place::machine;
  ++results_.statistics.instants;
  results_.trajectory.instant();
  due_.clear();
  const bool due = calendar_.due(time_) || arrives_by(time_);
  if (!at_start && (due || time_ >= t_end) && instant_.meets_stop(time_, t_end - time_))
    reason = StopReason::root;
  if (due || at_start) calendar_.take(time_, due_);
  if (reason != StopReason::root && !due && !at_start)
    return Status::reached_end;  // only the end of a major step
  major_.begin(time_);
  rows_.record(time_, instant_.jump(), machine_.x.data());  // the row that a failure leaves
  accepted_.rows = results_.time.size();
  const bool at_root = reason == StopReason::root;
  const bool idle = (at_root || instant_.may_wait()) && endings_.idle();
  const Outcome outcome = run_instant(t_end, at_start);
  const Chattering::Seen seen{time_, at_root, t_end - begin_.time(), instant_.set_off()};
  if (auto ending = endings_.after_instant(outcome, seen, idle, instant_.journal()))
    return end(*ending);
  return Status::reached_end;
}

/// Restarts the solver after the instant if its history is not valid any more.
Outcome Run::run_instant(double t_end, bool at_start) {
  accepted_.in_instant = true;
  const int jump = instant_.jump();
  const Outcome outcome = instant_.run(time_, due_, t_end - time_, at_start);
  if (tangents_) tangents_->log();
  if (instant_.jump() != jump) histories_.changed();
  accepted_ = {.place = Place::machine, .settled = true};
  const bool cut = instant_.stops_earlier() && integration_.inside_step();
  if (std::exchange(behind_event_, false) || outcome.restart || cut)
    integration_.restart(time_, {.horizon = outcome.horizon, .flow = instant_.flow()});
  return outcome;
}

}  // namespace saltus
