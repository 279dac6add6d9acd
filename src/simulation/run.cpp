// Run: the loop from instant to instant.
#include "saltus/simulation/detail/run.hpp"

#include "saltus/simulation/detail/option_table.hpp"

namespace saltus {

SimulatorOptions Run::checked(SimulatorOptions options) {
  detail::check(options);
  require_linear_solver(options.linear_solver, options.ode_solver_method);
  return options;
}

Run::Run(const System& system, SimulatorOptions options)
    : Run(compile(system, checked(options).recorded_signals), options) {}

Run::Run(std::shared_ptr<const Plan> plan, SimulatorOptions options)
    : options_(checked(std::move(options))),
      machine_(std::move(plan)),
      instant_(machine_, watch_, options_, results_),
      calendar_(machine_.plan()),
      method_(method_from(options_.ode_solver_method)) {}

void Run::initialize(const Context& context) {
  machine_.load(context);
  begin_ = context;
  time_ = context.time();
  results_.time.clear(), results_.jump.clear();
  results_.statistics = {}, results_.message.clear();
  results_.block.clear(), results_.cause = nullptr;
  start_recorder();
  results_.trajectory = {};
  if (options_.dense_output) results_.trajectory.start(machine_.shared_plan(), begin_, options_);
  calendar_.begin(time_, context.settled());
  begun_ = solver_started_ = over_ = false;
  next_save_ = 0, ticks_ = 0, stuck_ = fluttering_ = {}, recent_ = idle_ = {0, time_};
  at_root_ = machine_.x;
}

void Run::start_recorder() {
  recorder_.reset();
  if (!plan().taps.empty())
    recorder_.emplace(machine_, results_, options_.event_rows ? nullptr : &options_.save_at);
}

Results Run::take_results() {
  EventLog next = results_.events.emptied();
  Results taken = std::move(results_);
  results_.events = std::move(next);
  start_recorder();  // the columns went with the rest
  if (options_.dense_output && begun_) {
    results_.trajectory.start(machine_.shared_plan(), begin_, options_);
    results_.trajectory.open(time_, machine_, instant_.contacts());
  }
  return taken;
}

Status Run::advance_to(double t_end) {
  if (!(t_end >= time_)) {
    throw ModelError(text("cannot run from t = ", time_, " s back to t = ", t_end,
                          " s; the end has to be later"));
  }
  const auto start = std::chrono::steady_clock::now();
  asked_ = start;
  try {
    results_.status = run_to(t_end);
  } catch (const SimulationError& error) {
    fail(error.what());
    results_.block = error.block();
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("a function of the model threw");
  }
  results_.statistics.wall_time +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  finish();
  if (ended_well(results_.status) || !options_.throw_errors) return results_.status;
  const auto partial = std::make_shared<Results>(results_);
  partial->cause = nullptr;  // else the error would hold itself
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
    begun_ = true;
    Recorder* recorder = recorder_ ? &*recorder_ : nullptr;
    const Continuation* earlier = begin_.continuation();
    const bool resumes = earlier != nullptr && instant_.fits(*earlier);
    resumes ? instant_.resume(time_, recorder, *earlier, t_end - time_)
            : instant_.begin(time_, recorder);
    record(time_, machine_.x.data());
    if (options_.dense_output) results_.trajectory.open(time_, machine_, instant_.contacts());
    if (resumes)
      last_instant_ = time_;
    else if (const Status status = settle(StopReason::stop_time, t_end, true); over_)
      return status;
  }
  while (time_ < t_end) {
    if (options_.max_major_steps && results_.statistics.instants >= *options_.max_major_steps) {
      return end(Status::step_limit,
                 text("t = ", time_, " s: the run used its ", *options_.max_major_steps,
                      " major steps before t = ", t_end, " s; raise max_major_steps"));
    }
    if (const Status status = step(t_end); over_) return status;
    if ((++ticks_ & 15) == 0 && interrupted())
      return end(Status::interrupted, text("t = ", time_, " s: interrupted"));
  }
  return Status::reached_end;
}

/// One minor step, and the instant at its end if there is one.
Status Run::step(double t_end) {
  const double t_stop =
      std::min({t_end, calendar_.next(), last_instant_ + options_.max_major_step_length});
  const double from = time_;
  StopReason reason = StopReason::stop_time;
  if (options_.dense_output)
    results_.trajectory.depart(solver_started_ ? solver_->state() : machine_.x);
  move_to(t_stop, reason);
  if (options_.dense_output) keep_step(from);
  for (const MonitorHit& hit : watch_.monitors) {
    solver_->interpolate(hit.t, machine_.x.data());
    carry(hit.t);
    instant_.log_monitor(hit, machine_.x.data());
  }
  record_step(from);
  if (reason == StopReason::step) return Status::reached_end;
  return settle(reason, t_end, false);
}

/// Lets the solver move, where something moves.
void Run::move_to(double t_stop, StopReason& reason) {
  watch_.monitors.clear();
  if (plan().nx == 0 && !watch_.any()) {
    time_ = t_stop;
    return;
  }
  if (!solver_started_) {
    if (!solver_)
      solver_ = make_solver(plan().nx == 0 ? Method::dopri5 : method_, machine_, watch_,
                            solver_options());
    solver_->restart(time_, machine_.x, {.first = true});
    solver_started_ = true;
  }
  reason = solver_->advance(t_stop);
  time_ = solver_->time();
}

SolverOptions Run::solver_options() const {
  return {options_.rtol,
          options_.atol,
          options_.min_minor_step_size,
          options_.max_minor_step_size,
          linear_solver_from(options_.linear_solver),
          options_.find_sparsity};
}

/// The instant at time_, where there is one; restarts the solver if it has to forget.
Status Run::settle(StopReason reason, double t_end, bool at_start) {
  if (solver_started_) machine_.x = solver_->state(), carry(time_);
  machine_.at_home();
  ++results_.statistics.instants;
  last_instant_ = time_;
  results_.trajectory.instant();
  due_.clear();
  if (calendar_.due(time_) || at_start) calendar_.take(time_, due_);
  if (reason != StopReason::root && due_.empty() && !at_start)
    return Status::reached_end;  // a major step's end only
  record(time_, machine_.x.data());
  const bool idle = reason == StopReason::root && !moved();
  const Instant::Outcome outcome = instant_.run(time_, due_, t_end - time_, at_start);
  if (outcome.restart && solver_started_)
    solver_->restart(time_, machine_.x, {.horizon = outcome.horizon, .flow = instant_.flow()});
  if (outcome.terminal) return end(Status::terminal);
  if (outcome.zeno_stop) return end(Status::zeno_stop);
  if (outcome.chatters) told_ = {outcome.events, time_};
  stuck_.next(outcome.stuck, time_);
  fluttering_.next(outcome.flutters, time_);
  if (outcome.chatters || (reason == StopReason::root && chatters(t_end, idle)))
    return chattering();
  return Status::reached_end;
}

Status Run::chattering() {
  const std::string& name = instant_.last_event();
  results_.block = name.substr(0, name.rfind('.'));
  return end(Status::chattering,
             text("t = ", time_, " s: guard '", name.substr(name.rfind('.') + 1), "' of block '",
                  results_.block, "' fired ", told_.count, " times in ", time_ - told_.since,
                  " s: time does not advance. Give it hysteresis, a zeno_tolerance above 0 s, or a "
                  "mode of its own for the motion along the switching surface"));
}

/// Events go on, and time does not: a thousand times at rest without a Zeno monitor; two hundred
/// times in a row a relation whose both sides lead back to its surface; a thousand
/// roots within what rounding leaves of time; ten thousand in 1e-7 of the run, which would be 1e11
/// in all, between which no state moves by its tolerance.
bool Run::chatters(double t_end, bool idle) {
  const double rounding = 1e6 * std::numeric_limits<double>::epsilon() * std::abs(time_);
  if (stuck_.count >= 1000) return chatters_as(stuck_);
  if (fluttering_.count >= 200) return chatters_as(fluttering_);
  if (recent_.full(1000, time_) && time_ - recent_.since <= rounding) return chatters_as(recent_);
  at_root_ = machine_.x;
  if (!idle) idle_ = {0, time_};
  if (idle_.full(10'000, time_) && time_ - idle_.since <= 1e-7 * (t_end - begin_.time()))
    return chatters_as(idle_);
  return false;
}

/// Whether some state has moved by its tolerance since the last root.
bool Run::moved() const {
  for (Index i = 0; i < at_root_.size(); ++i) {
    const double tolerance = options_.atol + options_.rtol * std::abs(machine_.x[i]);
    if (!(std::abs(machine_.x[i] - at_root_[i]) <= tolerance)) return true;
  }
  return false;
}

bool Run::interrupted() {
  if (!options_.interrupt) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_ < std::chrono::milliseconds(20)) return false;
  asked_ = now;
  return options_.interrupt();
}

void Run::record(double t, const double* x) {
  if (recorder_ && !recorder_->has_row(t, instant_.jump()))
    recorder_->record(t, instant_.jump(), x);
}

/// Rows of the step from `from` to now: those at asked-for times, then its end.
void Run::record_step(double from) {
  if (!recorder_) return;
  const auto& wanted = options_.save_at;
  while (next_save_ < wanted.size() && wanted[next_save_] < from) ++next_save_;
  for (; next_save_ < wanted.size() && wanted[next_save_] <= time_; ++next_save_) {
    const double t = wanted[next_save_];
    if (solver_started_ && t < time_) solver_->interpolate(t, machine_.x.data());
    record(t, t < time_ || !solver_started_ ? machine_.x.data() : solver_->state().data());
  }
  if (steps_recorded())
    record(time_, solver_started_ ? solver_->state().data() : machine_.x.data());
}

/// For dense output: the polynomial, or the two, of the step from `from` to now.
void Run::keep_step(double from) {
  if (!solver_started_)
    return results_.trajectory.add(from, time_, 0, machine_, instant_.contacts(), machine_.x,
                                   [](double, double*) {});
  const int degree = plan().nx == 0 ? 0 : solver_->degree();
  const auto add = [&](double begin, double end, const Eigen::VectorXd& x_end) {
    results_.trajectory.add(begin, end, degree, machine_, instant_.contacts(), x_end,
                            [this](double t, double* x) { solver_->interpolate(t, x); });
  };
  const double joint = degree == 0 ? from : solver_->joint();
  if (from < joint && joint < time_) {
    solver_->interpolate(joint, machine_.x.data());
    add(from, joint, machine_.x);
    results_.trajectory.depart(machine_.x);
    from = joint;
  }
  add(from, time_, solver_->state());
}

/// In a handler: what was thrown is the cause.
void Run::fail(std::string message) {
  results_.status = Status::failed;
  results_.message = std::move(message);
  results_.cause = std::current_exception();
}

Status Run::end(Status status, std::string message) {
  over_ = true;
  results_.status = status;
  results_.message = std::move(message);
  return status;
}

/// Context, last row and counts.
void Run::finish() {
  const bool at_instant =
      results_.status == Status::terminal || results_.status == Status::zeno_stop;
  if (solver_started_ && !at_instant) machine_.x = solver_->state(), carry(time_);
  if (results_.status != Status::failed) record(time_, machine_.x.data());
  machine_.at_home();
  if (options_.dense_output)
    results_.trajectory.close(time_, machine_, instant_.contacts(),
                              results_.status != Status::failed);
  results_.context = context();
  Statistics& s = results_.statistics;
  if (solver_started_) static_cast<SolverStatistics&>(s) = solver_->statistics();
  s.stretches = solver_started_ ? solver_->stretches() : std::vector<Stretch>{};
  s.method = solver_started_ ? solver_->method() : "none: no continuous state";
  s.right_hand_side_calls = machine_.rhs_calls;
  s.guard_calls = machine_.guard_calls;
  s.jacobian_calls = machine_.jacobian_calls;
  s.events_by_name = instant_.counts();
}

Context Run::context() const {
  if (!begun_) return begin_;
  const bool whole = results_.status != Status::failed;  // else an instant was left half done
  return machine_.save(begin_, time_,
                       whole ? std::make_shared<const Continuation>(instant_.save()) : nullptr);
}

std::string Run::describe() const {
  const std::string linear = solver_ ? solver_->statistics().linear_solver : "";
  return plan().describe() +
         text("method: ", options_.ode_solver_method,
              solver_ ? text(" (", solver_->method(), ")") : "", "\n") +
         (linear.empty() ? "" : text("linear solver: ", linear, "\n"));
}

}  // namespace saltus
