// The point at which a fit ended, as a FitResult with its warnings.
#include "fit_result.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "fit_loss.hpp"
#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/detail/names.hpp"
#include "student.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Data, model and residuals by experiment and name.
std::vector<Compared> compared_of(const FitProblem& problem, const VectorXd& residuals) {
  std::vector<Compared> all;
  Index row = 0;
  for (const Trial& trial : problem.trials)
    for (const Observed& seen : trial.bound().observed) {
      const VectorXd residual = residuals.segment(row, seen.data.size());
      row += seen.data.size();
      all.push_back({trial.bound().name, seen.name, seen.is_event, seen.entry, seen.time, seen.data,
                     seen.data + residual.cwiseProduct(seen.sigma), residual});
    }
  return all;
}

std::string named_group(const Coordinates& coordinates, const std::vector<Index>& group) {
  std::string all;
  for (const Index k : group)
    all += text(all.empty() ? "'" : " and '", coordinates.place(k).label, "'");
  return all;
}

void add_uncertain(std::vector<std::string>& said, const FitProblem& problem, const FitPoint& point,
                   const Uncertainty& found, bool absolute) {
  for (const std::vector<Index>& group : found.undetermined) {
    const std::string names = named_group(problem.coordinates, group);
    said.push_back(group.size() == 1 ? text("the data do not determine ", names,
                                            "; fix it in the context, or give other data")
                                     : text("the data determine a combination of ", names,
                                            " only; fix one of them"));
  }
  if (found.saddle)
    said.emplace_back("the loss has no minimum there, so there are no standard errors");
  if (point.residuals.size() == point.u.size() && !absolute)
    said.emplace_back("as many data as parameters: standard errors need sigma and absolute_sigma");
}

void add_bounds(std::vector<std::string>& said, const Coordinates& coordinates, const VectorXd& u) {
  for (Index k = 0; k < u.size(); ++k)
    for (const double bound : {coordinates.lower[k], coordinates.upper[k]}) {
      const double size = std::max(std::abs(bound), std::abs(u[k]));
      if (std::isfinite(bound) && std::abs(u[k] - bound) <= close_to_bound * size)
        said.push_back(text("'", coordinates.place(k).label,
                            "' ended at a bound; its standard error does not count that"));
    }
}

std::string counted(const std::map<std::string, int>& counts) {
  std::string all;
  for (const auto& [name, count] : counts)
    all += text(all.empty() ? "'" : ", '", name, "' (", count, ")");
  return all;
}

/// Which derivatives come from differences of runs, and why.
void add_replaced(std::vector<std::string>& said, const FitRecord& record) {
  if (record.differences.empty()) return;
  const std::size_t more = record.reasons.size() > 1 ? record.reasons.size() - 1 : 0;
  said.push_back(text("differences of runs replace missing derivatives, by parameter (Jacobians): ",
                      counted(record.differences), "; ",
                      record.reasons.empty() ? "they are NaN" : record.reasons.front(),
                      more > 0 ? text(", and ", more, " more") : std::string()));
  if (!record.no_slope.empty())
    said.push_back(text("those runs failed too, and derivatives were taken as 0, by: ",
                        counted(record.no_slope)));
}

std::vector<std::string> warnings_of(const FitProblem& problem, const FitPoint& point,
                                     const Uncertainty& found, bool absolute) {
  std::vector<std::string> said;
  add_uncertain(said, problem, point, found, absolute);
  add_bounds(said, problem.coordinates, point.u);
  const FitRecord& record = problem.record;
  if (record.failures > 0)
    said.push_back(text(record.failures, " of ", record.evaluations,
                        " evaluations failed; the first: ", record.first_failure));
  add_replaced(said, record);
  return said;
}

void add_uncertainty(FitResult& result, const FitProblem& problem, const FitPoint& point,
                     const FitOptions& options) {
  const Uncertainty found = uncertainty_of(point.residuals, point.jacobian,
                                           {.rtol = problem.rtol,
                                            .loss = options.loss,
                                            .f_scale = options.f_scale,
                                            .absolute = options.absolute_sigma});
  const VectorXd slope = problem.coordinates.slope(problem.coordinates.outer(point.u));
  result.covariance = found.covariance.cwiseProduct(slope * slope.transpose());
  result.jacobian = point.jacobian * slope.cwiseInverse().asDiagonal();
  result.warnings = warnings_of(problem, point, found, options.absolute_sigma);
  result.freedom = options.absolute_sigma
                       ? std::numeric_limits<double>::infinity()
                       : static_cast<double>(point.residuals.size() - point.u.size());
}

}  // namespace

FitResult fit_result(const FitProblem& problem, const FitEnded& ended, const FitOptions& options) {
  FitResult result;
  const VectorXd values = problem.coordinates.outer(ended.point.u);
  result.parameters = problem.coordinates.named(ended.point.u);
  result.residuals = ended.point.residuals;
  add_uncertainty(result, problem, ended.point, options);
  result.cost = ended.cost, result.status = ended.status, result.message = ended.message;
  for (std::size_t k = 0; k < problem.trials.size(); ++k) {
    const VectorXd own = problem.of_run(values, static_cast<Index>(k));
    result.runs.push_back(problem.trials[k].show(own));
    result.contexts.push_back(problem.trials[k].start(own));
    result.missing += static_cast<int>(problem.trials[k].bound().missing);
  }
  result.compared = compared_of(problem, ended.point.residuals);
  result.evaluations = problem.record.evaluations, result.failures = problem.record.failures;
  result.first_failure = problem.record.first_failure;
  result.starts = ended.starts, result.wall_time = ended.wall_time;
  for (Index k = 0; k < values.size(); ++k)
    result.logarithms.push_back(problem.coordinates.is_log(k));
  return result;
}

double FitResult::value(std::string_view name) const {
  for (const NamedValue& one : parameters)
    if (one.name == name) return one.value;
  throw ModelError(text("the fit has no parameter '", name, "'",
                        known_names(name, detail::names_of(parameters))));
}

VectorXd FitResult::standard_errors() const { return covariance.diagonal().cwiseSqrt(); }

MatrixXd FitResult::correlation() const {
  const VectorXd errors = standard_errors();
  return covariance.cwiseQuotient(errors * errors.transpose());
}

std::vector<std::pair<double, double>> FitResult::confidence(double level) const {
  if (!(level > 0.0 && level < 1.0))
    throw ModelError(text("confidence: expected a level between 0 and 1, found ", level));
  const double t = student_quantile(std::max(freedom, 1.0), 0.5 + 0.5 * level);
  const VectorXd errors = standard_errors();
  std::vector<std::pair<double, double>> intervals;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const double value = parameters[k].value, half = t * errors[static_cast<Index>(k)];
    if (logarithms[k])
      intervals.emplace_back(value * std::exp(-half / value), value * std::exp(half / value));
    else
      intervals.emplace_back(value - half, value + half);
  }
  return intervals;
}

std::ostream& operator<<(std::ostream& out, const FitResult& fit) {
  out << "fit: " << to_string(fit.status) << " after " << fit.evaluations << " evaluations, "
      << fit.residuals.size() << " data";
  if (fit.missing > 0) out << " (" << fit.missing << " missing)";
  out << ", cost " << fit.cost << "\n";
  const VectorXd errors = fit.standard_errors();
  const auto intervals = fit.confidence();
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    out << "  " << fit.parameters[k].name << " = " << fit.parameters[k].value << " +- "
        << errors[static_cast<Index>(k)] << ", 95 %: " << intervals[k].first << " to "
        << intervals[k].second << "\n";
  for (const std::string& warning : fit.warnings) out << "  warning: " << warning << "\n";
  return out;
}

}  // namespace saltus
