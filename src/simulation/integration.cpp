// Integration: the solver of a run, its start and its counts.
#include "saltus/simulation/detail/integration.hpp"

#include "width.hpp"

namespace saltus {

namespace {

SolverOptions solver_options(const SimulatorOptions& options, Index n) {
  SolverOptions out{options.rtol,
                    options.atol,
                    options.min_minor_step_size,
                    options.max_minor_step_size,
                    options.linear_solver,
                    options.find_sparsity};
  out.first_step = options.first_step.value_or(0.0);
  if (n > 0 && (options.rtol.by_state() || options.atol.by_state()))
    out.rtols = each_of(options.rtol, n), out.atols = each_of(options.atol, n);
  return out;
}

}  // namespace

Integration::Integration(Machine& machine, GuardSet& guards, const SimulatorOptions& options)
    : machine_(&machine), guards_(&guards), options_(&options) {
  require_series(machine.plan(), options.ode_solver_method);
}

/// Without states, the solver only locates the zeros of guards: any method will do.
void Integration::make() {
  solver_ = make_solver(still() ? Method::dopri5 : options_->ode_solver_method, *machine_, *guards_,
                        solver_options(*options_, machine_->plan().nx));
}

void Integration::begin() {
  started_ = behind_ = false;
  inside_ = machine_->x;
}

void Integration::start(double t) {
  if (!solver_) make();
  solver_->restart(t, machine_->x, {.first = true});
  started_ = true, behind_ = false;
}

void Integration::take_state(double t) {
  if (!started_) return;
  machine_->x = solver_->state();
  machine_->put_carried(t, machine_->x.data());
}

void Integration::report(Statistics& statistics) const {
  if (started_) static_cast<SolverStatistics&>(statistics) = solver_->statistics();
  statistics.stretches = started_ ? solver_->stretches() : std::vector<Stretch>{};
  statistics.method = started_ ? solver_->method() : "none: no continuous state";
}

std::string Integration::describe() const {
  const std::string linear = solver_ ? solver_->statistics().linear_solver : "";
  return text("method: ", to_string(options_->ode_solver_method),
              solver_ ? text(" (", solver_->method(), ")") : "", "\n") +
         (linear.empty() ? "" : text("linear solver: ", linear, "\n"));
}

}  // namespace saltus
