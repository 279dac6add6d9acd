// Run: begun at a context, advanced, and failed or finished.
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
      "islands = true, or begin anew from its values: set its time to the same value by with_time");
}

/// A context that continues a run has states that the run led to.
void check_start(const Machine& machine, const Context& context) {
  if (context.continuation() != nullptr) return;
  const Plan& plan = machine.plan();
  for (const int number : plan.starting) {
    const PlanLeaf& leaf = plan.leaf(number);
    const VectorView state(machine.x.data() + leaf.x, leaf.nx);
    const ParameterValues values({machine.p.data() + leaf.p, leaf.np});
    for (const StartCheck& check : leaf.declared().start_checks)
      check(leaf.path, context.time(), state, values);
  }
}

}  // namespace

Run::Run(const System& system, SimulatorOptions options)
    : Run(compile(system, checked(options).recorded_signals, options.refinement.get()), options) {
  options_.refinement.reset();  // the plan does not need it any more
}

void Run::functions_replaced() {
  plan().series->forget();
  plan().divisors->forget();
  plan().waves->forget();
  machine_.functions_replaced();  // first: a method that does not suit them now must not go on
  require_series(machine_.plan(), options_.ode_solver_method);
}

Run::Run(std::shared_ptr<const Plan> plan, SimulatorOptions options)
    : RunLoop(plan, checked_for(*plan, std::move(options))) {}

/// A context that is refused leaves the run as it is.
void Run::initialize(const Context& context) {
  require_context_of(plan(), context);
  require_common_step(context);
  if (context.continuation() != nullptr) instant_.fits(*context.continuation());
  if (tangents_) tangents_->require_fits(context);
  instant_.queues().require_fits(context);
  calendar_.check(context.time());
  Context last = std::exchange(begin_, {});  // no run, if a function of the model throws now
  machine_.load(context);
  check_start(machine_, context);
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
  instant_.queues().begin(context);
  integration_.begin();
  begun_ = over_ = behind_event_ = false;
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

}  // namespace saltus
