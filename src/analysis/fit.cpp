// fit: the arguments, the starts, and the best of them.
#include "saltus/analysis/fit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "fit_problem.hpp"
#include "fit_result.hpp"
#include "fit_search.hpp"
#include "orbit_runs.hpp"
#include "places.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Eigen::VectorXd;
using FitClock = std::chrono::steady_clock;

void require_options(const FitOptions& options) {
  require_own_options("fit", options.simulation);
  if (!options.simulation.recorded_signals.empty())
    throw ModelError("fit: the option 'recorded_signals' is set by it: the data name the signals");
  const auto positive = [](std::string_view name, double value) {
    if (!(value > 0.0 && std::isfinite(value)))
      throw ModelError(text("fit: ", name, ": expected a number above 0, found ", value));
  };
  positive("f_scale", options.f_scale), positive("ftol", options.ftol);
  positive("xtol", options.xtol), positive("sigma", options.sigma.value_or(1.0));
  if (options.starts < 1)
    throw ModelError(
        text("fit: starts: expected a number of starts, 1 or more, found ", options.starts));
  if (!std::isfinite(options.seed))
    throw ModelError(text("fit: seed: expected a finite number, found ", options.seed));
  if (options.max_nfev && *options.max_nfev < 1)
    throw ModelError(
        text("fit: max_nfev: expected an integer of 1 or more, found ", *options.max_nfev));
}

/// The names of the experiments: their own, or "run 1", "run 2", ...
std::vector<std::string> names_of(const std::vector<Experiment>& data) {
  if (data.empty()) throw ModelError("fit: data: expected at least one data set, found none");
  std::vector<std::string> names;
  for (std::size_t k = 0; k < data.size(); ++k)
    names.push_back(data[k].name.empty() ? text("run ", k + 1) : data[k].name);
  if (std::set<std::string>(names.begin(), names.end()).size() < names.size())
    throw ModelError(
        text("fit: two experiments have one name; expected different ones: ", quoted_list(names)));
  return names;
}

FitPlace fit_place(const std::string& where, const Context& context, const FreeValue& free,
                   const std::string& prefix, Index run) {
  const ContextEntry entry = number_in(where, context, free.name);
  const double value = value_in(context, entry);
  return {prefix + free.name, free.name, detail::with_start(where + ": parameter", free, value),
          entry, run};
}

bool same_number(const ContextEntry& a, const ContextEntry& b) {
  return a.kind == b.kind && a.first == b.first;
}

/// Two names may mean one number of a context: "x[0]" and "height".
void refuse_twice(const std::vector<FitPlace>& places, const Experiment& experiment,
                  const BoundExperiment& bound, Index run) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].is_in(run)) continue;
    for (std::size_t k = 0; k < i; ++k)
      if (places[k].is_in(run) && same_number(places[i].entry, places[k].entry))
        throw ModelError(
            text(bound.where, ": '", places[k].name, "' and '", places[i].name, "' are one value"));
    for (const NamedValue& value : experiment.values)
      if (same_number(find_entry(bound.context.layout(), value.name), places[i].entry))
        throw ModelError(text(bound.where, ": '", value.name,
                              "' is fitted, and has a value in this experiment; remove one of "
                              "them"));
  }
}

/// All parameters of a fit, each with a start value, in the order of the result.
std::vector<FitPlace> places_of(const std::vector<FreeValue>& parameters,
                                const std::vector<Experiment>& data,
                                const std::vector<BoundExperiment>& bound) {
  std::vector<FitPlace> places;
  for (const FreeValue& free : parameters)
    places.push_back(fit_place("fit", bound.front().context, free, "", -1));
  for (std::size_t k = 0; k < data.size(); ++k)
    for (const FreeValue& free : data[k].free)
      places.push_back(fit_place(bound[k].where, bound[k].context, free, bound[k].name + ": ",
                                 static_cast<Index>(k)));
  if (places.empty()) throw ModelError("fit: parameters: expected at least one, found none");
  for (std::size_t k = 0; k < data.size(); ++k)
    refuse_twice(places, data[k], bound[k], static_cast<Index>(k));
  return places;
}

void require_enough(const FitProblem& problem, bool absolute) {
  Index missing = 0;
  std::set<std::string> lacking;
  for (const Trial& trial : problem.trials) {
    missing += trial.bound().missing;
    lacking.insert(trial.bound().without_sigma.begin(), trial.bound().without_sigma.end());
  }
  const Index needed = problem.coordinates.size();
  if (problem.data.size() < needed)
    throw ModelError(text("fit: expected at least ", needed, " data, as many as parameters, found ",
                          problem.data.size(),
                          missing > 0 ? text(", without ", missing, " that are NaN") : "",
                          "; give more data, or fix parameters in the context"));
  if (absolute && !lacking.empty())
    throw ModelError(
        text("fit: absolute_sigma needs the standard deviation of all data; there is none of ",
             quoted_list({lacking.begin(), lacking.end()})));
}

/// The start of the user, then drawn ones; of a logarithm in equal factors.
std::vector<VectorXd> starts_of(const Coordinates& coordinates, const FitOptions& options) {
  std::vector<VectorXd> starts{coordinates.start};
  if (options.starts == 1) return starts;
  for (Index k = 0; k < coordinates.size(); ++k)
    if (!std::isfinite(coordinates.lower[k]) || !std::isfinite(coordinates.upper[k]))
      throw ModelError(text("fit: starts = ", options.starts,
                            " are drawn between the bounds, and '", coordinates.place(k).label,
                            "' has none, or 0 with log; give a lower and an upper bound"));
  for (VectorXd& drawn : detail::latin_hypercube(coordinates.lower, coordinates.upper,
                                                 options.starts - 1, options.seed))
    starts.push_back(std::move(drawn));
  return starts;
}

FitProblem problem_of(const System& system, const Context& context,
                      const std::vector<Experiment>& data, const std::vector<FreeValue>& parameters,
                      const FitOptions& options) {
  const std::vector<std::string> names = names_of(data);
  std::vector<BoundExperiment> bound;
  for (std::size_t k = 0; k < data.size(); ++k)
    bound.push_back(bound_experiment(system, data[k], names[k], context, options));
  std::vector<FitPlace> places = places_of(parameters, data, bound);
  std::vector<Trial> trials;
  for (std::size_t k = 0; k < bound.size(); ++k) {
    std::vector<TrialParameter> of_run;
    for (const FitPlace& place : places)
      if (place.is_in(static_cast<Index>(k))) of_run.push_back({place.name, place.entry});
    trials.emplace_back(system, std::move(bound[k]), std::move(of_run), options.simulation);
  }
  return {std::move(trials), Coordinates(std::move(places)), options.simulation.rtol.smallest()};
}

}  // namespace

FitResult fit(const System& system, const Context& context, const std::vector<Experiment>& data,
              const std::vector<FreeValue>& parameters, const FitOptions& options) {
  const auto begun = FitClock::now();
  require_options(options);
  FitProblem problem = problem_of(system, context, data, parameters, options);
  require_enough(problem, options.absolute_sigma);
  const std::vector<VectorXd> starts = starts_of(problem.coordinates, options);
  FitEnded ended = search_fit(problem, starts, options);
  ended.wall_time = std::chrono::duration<double>(FitClock::now() - begun).count();
  return fit_result(problem, ended, options);
}

FitResult fit(const System& system, const Context& context, const Experiment& data,
              const std::vector<FreeValue>& parameters, const FitOptions& options) {
  return fit(system, context, std::vector<Experiment>{data}, parameters, options);
}

}  // namespace saltus
