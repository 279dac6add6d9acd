// The runs of one search.
#include "orbit_runs.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"

namespace saltus {

void require_own_options(const std::string& where, const SimulatorOptions& options) {
  const std::pair<std::string_view, bool> own[] = {
      {"sensitivity", !options.sensitivity.empty()}, {"dense_output", options.dense_output},
      {"save_at", !options.save_at.empty()},         {"save_steps", options.save_steps.has_value()},
      {"event_rows", !options.event_rows},           {"record_events", !options.record_events},
      {"throw_errors", !options.throw_errors}};
  for (const auto& [name, given] : own)
    if (given)
      throw ModelError(text(where, ": the option '", name, "' is set by it; leave it out"));
}

OrbitRuns::OrbitRuns(std::string where, const System& system, SimulatorOptions options)
    : where_(std::move(where)), system_(system), options_(std::move(options)) {
  require_own_options(where_, options_);
  if (!options_.recorded_signals.empty())
    throw ModelError(text(where_,
                          ": the option 'recorded_signals' of the runs is set by it; leave "
                          "it out"));
  plan_ = compile(system_, {}, options_.refinement.get());
}

SimulatorOptions OrbitRuns::shared_options() const {
  SimulatorOptions options = options_;
  options.refinement.reset();  // the plan has it
  return options;
}

Results OrbitRuns::through(Simulator& simulator, const Context& context, double end) const {
  simulator.initialize(context);
  require_reached(simulator.results(), simulator.advance_to(end));
  return simulator.take_results();
}

Results OrbitRuns::once(const Context& context, double end, SimulatorOptions options) const {
  Results results = simulate(system_, context, {context.time(), end}, options);
  require_reached(results, results.status);
  return results;
}

Results OrbitRuns::plain(const Context& context, double end) {
  if (!plain_) plain_.emplace(plan_, shared_options());
  return through(*plain_, context, end);
}

Results OrbitRuns::dense(const Context& context, double end, RecordedSignals signals) {
  SimulatorOptions options = options_;
  options.dense_output = true, options.recorded_signals = std::move(signals);
  return once(context, end, std::move(options));
}

Results OrbitRuns::derived(const Context& context, double end,
                           const std::vector<std::string>& names) {
  if (!derived_ || derived_names_ != names) {
    SimulatorOptions options = shared_options();
    options.sensitivity = derived_names_ = names;
    derived_.emplace(plan_, std::move(options));
  }
  return through(*derived_, context, end);
}

Results OrbitRuns::recorded(const Context& context, double end,
                            const std::vector<std::string>& names, RecordedSignals signals) {
  SimulatorOptions options = options_;
  options.sensitivity = names, options.recorded_signals = std::move(signals);
  return once(context, end, std::move(options));
}

Eigen::VectorXd OrbitRuns::flow(const Context& context) {
  if (!still_) still_.emplace(plan_);
  still_->begin(context);
  Machine& machine = still_->machine();
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(machine.x.size() + context.discrete_state().size());
  machine.derivative(still_->time(), machine.x.data(), rates.data());
  return rates;
}

EventLog OrbitRuns::firings(const Context& context, const std::string& section, int count,
                            double longest, double beyond) {
  if (!plain_) plain_.emplace(plan_, shared_options());
  Simulator& run = *plain_;
  run.initialize(context);
  const double begin = context.time();
  double span = span_ > 0.0 ? span_ : longest * std::pow(span_growth, -first_halvings);
  Status status = Status::reached_end;
  std::vector<double> times;
  while (true) {
    span = std::min(span, longest);
    status = run.advance_to(begin + span);
    times = run.results().events.times(section);
    if (std::ssize(times) >= count) break;
    require_reached(run.results(), status);
    if (span >= longest) refuse_unreached(section, times.size(), count, begin, longest);
    span *= span_growth;
  }
  const double way = times[static_cast<std::size_t>(count) - 1] - begin;
  require_zero_crossing(run.results().events, section);
  span_ = way > 0.0 ? span_beyond * way : span;
  if (begin + way + beyond * way > run.time() && status == Status::reached_end)
    run.advance_to(begin + way + beyond * way);
  return run.results().events;
}

void OrbitRuns::require_reached(const Results& results, Status status) const {
  if (status != Status::reached_end) ended_early(results, status);
}

void OrbitRuns::ended_early(const Results& results, Status status) const {
  const double at = results.context.time();
  std::string cause, block;
  if (!results.events.empty()) {
    const Event last = results.events[results.events.size() - 1];
    block = last.block;
    cause = text(" by the event '", last.block, ".", last.name, "'");
  }
  SimulationError error(
      text(where_, ": t = ", at, " s: the run ended", cause, ", with the status '",
           to_string(status),
           "'; expected a system that goes on: choose another guard, or one that does not end the "
           "run"),
      at, block);
  error.attach(std::make_shared<Results>(results));
  throw error;
}

void OrbitRuns::refuse_unreached(const std::string& section, std::size_t found, int count,
                                 double begin, double longest) const {
  throw SimulationError(
      text(where_, ": t = ", begin + longest, " s: the section '", section, "' has fired ", found,
           " of ", count, " times since t = ", begin, " s; expected ", count, " within ", longest,
           " s: give a larger max_period, another start, or another section"),
      begin + longest);
}

void OrbitRuns::require_zero_crossing(const EventLog& log, const std::string& section) const {
  std::set<EventKind> kinds;
  for (const std::size_t i : events_called(log, section)) kinds.insert(log[i].kind);
  if (kinds.contains(EventKind::terminal))
    throw ModelError(
        text(where_, ": the section '", section, "' ends the run; expected a guard that does not"));
  if (kinds.contains(EventKind::time))
    throw ModelError(text(where_, ": the section '", section,
                          "' is a time event; expected a guard. Give a period for a system that a "
                          "clock drives"));
}

}  // namespace saltus
