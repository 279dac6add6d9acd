// fit: the arguments, the starts, and the best of them.
#include "saltus/analysis/fit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include "fit_loss.hpp"
#include "fit_problem.hpp"
#include "fit_result.hpp"
#include "orbit_runs.hpp"
#include "places.hpp"
#include "saltus/analysis/detail/least_squares.hpp"
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

/// Searches from one start after the other.
class FitSearch {
 public:
  FitSearch(FitProblem& problem, const FitOptions& options) : problem_(problem), options_(options) {
    problem.seen = [this] { seen(); };
  }
  ~FitSearch() {
    problem_.seen = [] {};
  }
  FitSearch(const FitSearch&) = delete;
  FitSearch& operator=(const FitSearch&) = delete;

  /// The best of all starts, a converged one if there is any.
  FitEnded run(const std::vector<VectorXd>& starts) {
    count_ = static_cast<int>(starts.size());
    try {
      for (const VectorXd& u : starts) from(u);
    } catch (const FitStopped& stopped) {
      if (!problem_.best) throw_failed_fit(stopped.what());
      return {*problem_.best,
              0.5 * problem_.best->residuals.squaredNorm(),
              SearchStatus::interrupted,
              stopped.what(),
              ended_,
              0.0};
    }
    const Found* best = nullptr;
    for (const Found& found : found_)
      if (!best || rank(found) < rank(*best)) best = &found;
    if (!best) throw_failed_fit({});
    return {best->point, best->start.cost, best->start.status, best->start.message, ended_, 0.0};
  }

 private:
  struct Found {
    FitStart start;
    FitPoint point;
  };
  static std::pair<bool, double> rank(const Found& found) {
    return {found.start.status != SearchStatus::converged, found.start.cost};
  }

  void seen() {
    if (options_.progress) options_.progress(progress());
    if (options_.simulation.interrupt && options_.simulation.interrupt())
      throw FitStopped("the option interrupt has ended the fit");
  }

  FitProgress progress() const {
    const bool any = problem_.best.has_value();
    return {problem_.record.evaluations,
            any ? problem_.best->residuals.squaredNorm() : std::numeric_limits<double>::infinity(),
            any ? problem_.coordinates.named(problem_.best->u) : std::vector<NamedValue>(),
            problem_.record.failures,
            std::min(static_cast<int>(ended_.size()), count_ - 1),
            count_};
  }

  void from(const VectorXd& u) {
    const int before = problem_.record.evaluations;
    FitStart start{.start = problem_.coordinates.named(u), .parameters = {}, .message = {}};
    if (!problem_.at(u)) {
      start.parameters = start.start;
      start.cost = std::numeric_limits<double>::infinity();
      start.status = SearchStatus::failed, start.message = problem_.failed->what();
    } else {
      const detail::LeastSquaresFound found = minimised(u);
      const FitPoint point = *problem_.at(back(found.x, u));
      start.parameters = problem_.coordinates.named(point.u);
      start.cost = found.cost;
      judge(start, found, point);
      found_.push_back({start, point});
    }
    start.evaluations = problem_.record.evaluations - before;
    if (!found_.empty()) found_.back().start.evaluations = start.evaluations;
    ended_.push_back(std::move(start));
  }

  /// The parameters of the search have sizes near 1 at its start.
  VectorXd back(const VectorXd& w, const VectorXd& start) const {
    const Coordinates& of = problem_.coordinates;
    return w.cwiseProduct(of.scale(start)).cwiseMax(of.lower).cwiseMin(of.upper);
  }

  detail::LeastSquaresFound minimised(const VectorXd& u) {
    const Coordinates& of = problem_.coordinates;
    const VectorXd scale = of.scale(u);
    detail::LeastSquares squares;
    squares.cost = [&](const VectorXd& w) -> std::optional<double> {
      const FitPoint* point = problem_.at(back(w, u));
      if (!point) return {};
      return cost_of(point->residuals, options_.loss, options_.f_scale);
    };
    squares.linear = [&](const VectorXd& w, VectorXd& residual, Eigen::MatrixXd& jacobian) {
      const FitPoint& point = *problem_.at(back(w, u));
      residual = point.residuals, jacobian = point.jacobian * scale.asDiagonal();
      weigh(residual, jacobian, options_.loss, options_.f_scale);
    };
    const int most = options_.max_nfev.value_or(100 * static_cast<int>(u.size()));
    return detail::least_squares(
        squares, u.cwiseQuotient(scale), of.lower.cwiseQuotient(scale),
        of.upper.cwiseQuotient(scale),
        {.cost = options_.ftol, .step = options_.xtol, .evaluations = most});
  }

  void judge(FitStart& start, const detail::LeastSquaresFound& found, const FitPoint& point) {
    using detail::LeastSquaresEnd;
    if (found.end == LeastSquaresEnd::evaluations) {
      start.status = SearchStatus::max_nfev;
      start.message =
          text(found.evaluations, " evaluations were not enough; give max_nfev, or starts");
    } else if (found.end == LeastSquaresEnd::step && problem_.meets_jump(point)) {
      start.status = SearchStatus::stalled;
      start.message =
          "no shorter step lowers the cost, and its gradient is not zero: the cost jumps there, as "
          "where a sequence of events changes, or runs fail; give starts, or other data";
    } else {
      constexpr std::string_view why[] = {"the gradient is zero", "ftol: the cost changes no more",
                                          "xtol: the parameters change no more"};
      start.message = nth(why, found.end);
    }
  }

  [[noreturn]] void throw_failed_fit(const std::string& stopped) const {
    const auto& failed = problem_.failed;
    const auto results = failed ? failed->results : nullptr;
    const std::string what = !stopped.empty()
                                 ? stopped
                                 : text("the run with ",
                                        count_ == 1 ? std::string("the start values")
                                                    : text("each of ", count_, " starts"),
                                        " failed: ", problem_.record.first_failure,
                                        "; give other start values or bounds");
    SimulationError error(
        "fit: " + what,
        results ? results->context.time() : std::numeric_limits<double>::quiet_NaN(),
        results ? results->block : std::string());
    error.attach(results);
    throw error;
  }

  FitProblem& problem_;
  const FitOptions& options_;
  std::vector<Found> found_;
  std::vector<FitStart> ended_;
  int count_ = 1;
};

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
  FitEnded ended = FitSearch(problem, options).run(starts);
  ended.wall_time = std::chrono::duration<double>(FitClock::now() - begun).count();
  return fit_result(problem, ended, options);
}

FitResult fit(const System& system, const Context& context, const Experiment& data,
              const std::vector<FreeValue>& parameters, const FitOptions& options) {
  return fit(system, context, std::vector<Experiment>{data}, parameters, options);
}

}  // namespace saltus
