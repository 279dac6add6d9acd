// The results of a run: rows, dense output, the final context, counts.
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

void Run::record(double t, const double* x) {
  if (recorder_ && !recorder_->has_row(t, instant_.jump()))
    recorder_->record(t, instant_.jump(), x);
}

/// Records the step from `from` to now: the rows at requested times, then the row at its end.
void Run::record_step(double from) {
  if (!recorder_) return;
  const auto& wanted = options_.save_at;
  while (next_save_ < wanted.size() && wanted[next_save_] < from) ++next_save_;
  for (; next_save_ < wanted.size() && wanted[next_save_] <= time_; ++next_save_) {
    const double t = wanted[next_save_];
    const bool inside = solver_started_ && t < time_;
    if (inside) solver_->interpolate(t, row_.data());
    record(t, inside ? row_.data() : present_state().data());
  }
  if (options_.save_steps.value_or(wanted.empty())) record(time_, present_state().data());
}

/// Keeps the one or two polynomials of the step from `from` to now for dense output.
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
    solver_->interpolate(joint, row_.data());
    add(from, joint, row_);
    results_.trajectory.depart(row_);
    from = joint;
  }
  add(from, time_, solver_->state());
}

/// Completes the results: context, last row and counts.
void Run::finish() {
  const bool at_instant =
      results_.status == Status::terminal || results_.status == Status::zeno_stop;
  const bool whole = results_.status != Status::failed;
  if (solver_started_ && !at_instant && whole) take_state();
  if (whole) record(time_, machine_.x.data());
  if (options_.dense_output) results_.trajectory.close(time_, machine_, instant_.contacts(), whole);
  results_.context = context();
  Statistics& s = results_.statistics;
  if (solver_started_) static_cast<SolverStatistics&>(s) = solver_->statistics();
  s.stretches = solver_started_ ? solver_->stretches() : std::vector<Stretch>{};
  s.method = solver_started_ ? solver_->method() : "none: no continuous state";
  s.right_hand_side_calls = machine_.rhs_calls;
  s.guard_calls = machine_.guard_calls;
  s.jacobian_calls = machine_.jacobian_calls;
  s.events_by_name = instant_.journal().counts();
}

Context Run::context() const {
  if (!begun_) return begin_;
  if (results_.status == Status::failed && accepted_.place == Place::start) return begin_;
  const bool settled = results_.status != Status::failed || accepted_.settled;
  return machine_.save(begin_, time_, std::make_shared<const Continuation>(instant_.save()),
                       settled);
}

std::string Run::describe() const {
  const std::string linear = solver_ ? solver_->statistics().linear_solver : "";
  return plan().describe() +
         text("method: ", to_string(options_.ode_solver_method),
              solver_ ? text(" (", solver_->method(), ")") : "", "\n") +
         (linear.empty() ? "" : text("linear solver: ", linear, "\n"));
}

}  // namespace saltus
