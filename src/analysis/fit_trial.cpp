// The runs of one experiment.
#include "fit_trial.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/plan/compile.hpp"

namespace saltus {

namespace {

bool is_interrupted(const SimulationError& error) {
  return error.results() && error.results()->status == Status::interrupted;
}

[[noreturn]] void throw_failed(const std::string& what, std::shared_ptr<const Results> results) {
  RunFailed failed(what);
  failed.results = std::move(results);
  throw failed;
}

}  // namespace

Trial::Trial(const System& system, BoundExperiment bound, std::vector<TrialParameter> parameters,
             const SimulatorOptions& options)
    : system_(system),
      bound_(std::move(bound)),
      parameters_(std::move(parameters)),
      options_(options),
      plan_(compile(system, bound_.recorded, options.refinement.get())) {
  SimulatorOptions quick = options_;
  quick.refinement.reset();  // the plan has it
  quick.save_at = bound_.times, quick.save_steps = false;
  quick.event_rows = bound_.times.empty();  // without times there are no rows to choose
  quick.record_events = std::ranges::any_of(bound_.observed, &Observed::is_event);
  plain_.emplace(plan_, quick);
  plain_->initialize(bound_.context);  // refuses what no run can do
  require_events();
  begin_with_derivatives(std::move(quick));
  Index size = 0, at = 0;
  for (const Observed& seen : bound_.observed) size += seen.data.size();
  data_.resize(size), sigma_.resize(size);
  for (const Observed& seen : bound_.observed) {
    data_.segment(at, seen.data.size()) = seen.data;
    sigma_.segment(at, seen.data.size()) = seen.sigma;
    at += seen.data.size();
  }
}

/// A simulator with derivatives, if the system has any.
void Trial::begin_with_derivatives(SimulatorOptions options) {
  for (const TrialParameter& one : parameters_) options.sensitivity.push_back(one.name);
  try {
    derived_.emplace(plan_, std::move(options));
    derived_->initialize(bound_.context);
  } catch (const ModelError& error) {
    derived_.reset();
    no_derivatives_ = error.what();
  }
}

void Trial::require_events() const {
  for (const Observed& seen : bound_.observed) {
    if (!seen.is_event) continue;
    try {
      plain_->results().events.times(seen.name, seen.kind);
    } catch (const ModelError& error) {
      throw ModelError(text(bound_.where, ": event times: ", error.what()));
    }
  }
}

Context Trial::start(const Eigen::VectorXd& values) const {
  Context context = bound_.context;
  for (Index k = 0; k < values.size(); ++k)
    write_entry(context, nth(parameters_, k).entry, {&values[k], 1}, nth(parameters_, k).name);
  return context;
}

Evaluation Trial::evaluate(const Eigen::VectorXd& values) {
  const auto count = static_cast<Index>(parameters_.size());
  if (!derived_) {
    FitModel found = model(run(*plain_, values), 0);
    found.derivatives.setConstant(found.values.size(), count,
                                  std::numeric_limits<double>::quiet_NaN());
    return {std::move(found), {no_derivatives_}};
  }
  const Results& results = run(*derived_, values);
  Evaluation found{model(results, count)};
  if (!found.model.derivatives.allFinite())
    for (const SensitivityGap& gap : results.sensitivities.gaps)
      found.reasons.push_back(
          text(gap.event, " at t = ", gap.time, " s, by ", gap.parameter, ": ", gap.reason));
  return found;
}

Eigen::VectorXd Trial::predict(const Eigen::VectorXd& values) {
  return model(run(*plain_, values), 0).values;
}

FitModel Trial::model(const Results& results, Index count) const {
  FitModel all{Eigen::VectorXd(data_.size()), Eigen::MatrixXd(data_.size(), count)};
  Index at = 0;
  for (const Observed& seen : bound_.observed) {
    const FitModel part = seen.model(results, count);
    all.values.segment(at, part.values.size()) = part.values;
    all.derivatives.middleRows(at, part.values.size()) = part.derivatives;
    at += part.values.size();
  }
  for (Index k = 0; k < at; ++k)
    if (!std::isfinite(all.values[k]))
      throw_failed(text("the value ", k, " of the run is not finite"),
                   std::make_shared<Results>(results));
  return all;
}

/// A callback may throw anything at a value that makes no sense.
const Results& Trial::run(Simulator& simulator, const Eigen::VectorXd& values) {
  Status status = Status::failed;
  try {
    simulator.initialize(start(values));
    status = simulator.advance_to(bound_.span.end);
  } catch (const Interruption&) {
    throw;
  } catch (const SimulationError& error) {
    if (is_interrupted(error)) throw FitStopped(error.what());
    throw_failed(error.what(), error.results());
  } catch (const std::exception& error) {
    throw_failed(error.what(), {});
  }
  const Results& results = simulator.results();
  if (!ended_well(status) || results.time.size() < bound_.times.size())
    throw_failed(text("the run ended at t = ", results.context.time(), " s (", to_string(status),
                      "), before the last time of the data"),
                 std::make_shared<Results>(results));
  return results;
}

Results Trial::show(const Eigen::VectorXd& values) const {
  SimulatorOptions options = options_;
  options.recorded_signals = bound_.recorded, options.save_at = bound_.times;
  options.save_steps = true, options.dense_output = true, options.throw_errors = false;
  return simulate(system_, start(values), bound_.span, options);
}

}  // namespace saltus
