// PythonPlan: the parts of a run that it does not change.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "plan_tapes.hpp"
#include "saltus/plan/compile.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "trace_pass.hpp"

namespace saltus::python {

/// A plan with the options it was made for. Any number of runs may use it at once, because each has
/// a memory of its own. It refers to the blocks of the system and keeps none alive. Only the option
/// `interrupt` keeps an object of Python alive.
class PythonPlan {
 public:
  /// Throws ModelError for an impossible system or option.
  PythonPlan(const System& system, SimulatorOptions options, const py::object& callbacks,
             const std::string& machine_code)
      : options_(checked(std::move(options))),
        pass_(trace_pass(callbacks)),
        plan_(compile(system, std::exchange(options_.recorded_signals, {}), pass_.get())),
        tapes_(*plan_, machine_code_when(machine_code), interpreted_by(callbacks),
               series_order(options_)) {
    options_.throw_errors = false;
    if (pass_) pass_->end();
  }

  const SimulatorOptions& options() const { return options_; }
  const std::shared_ptr<const Plan>& plan() const { return plan_; }

  /// Uses the present traces from now on, see TracePass. The plan must belong to a single
  /// simulator.
  bool replace_traces() { return !pass_ || pass_->replace(); }

  PlanTapes& tapes() { return tapes_; }

 private:
  static SimulatorOptions checked(SimulatorOptions options) {
    detail::check(options);
    return options;
  }

  SimulatorOptions options_;
  std::shared_ptr<TracePass> pass_;  // null if every function is called
  std::shared_ptr<const Plan> plan_;
  PlanTapes tapes_;
};

}  // namespace saltus::python
