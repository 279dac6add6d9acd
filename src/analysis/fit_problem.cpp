// Residuals and their Jacobian, from the runs of all experiments.
#include "fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The step of a central difference of runs with the relative tolerance `rtol`. With an error rtol of
/// each run and h^2 of the difference their sum is least near the cube root of rtol (J. Dennis,
/// R. Schnabel, Numerical Methods for Unconstrained Optimization, 1983, 5.6).
double difference_step(double value, double rtol) {
  return std::cbrt(std::max(rtol, unit_rounding)) * std::max(std::abs(value), least_scale);
}

void add_once(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& one : more)
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
}

}  // namespace

Coordinates::Coordinates(std::vector<FitPlace> places) : places_(std::move(places)) {
  const auto n = static_cast<Index>(places_.size());
  start.resize(n), lower.resize(n), upper.resize(n);
  for (Index k = 0; k < n; ++k) {
    const FreeValue& free = place(k).free;
    start[k] = inner(k, *free.start);
    lower[k] = inner(k, free.lower), upper[k] = inner(k, free.upper);
  }
}

double Coordinates::inner(Index k, double value) const {
  return is_log(k) ? std::log(std::max(value, 0.0)) : value;
}

VectorXd Coordinates::outer(const VectorXd& u) const {
  VectorXd values = u;
  for (Index k = 0; k < u.size(); ++k)
    if (is_log(k)) values[k] = std::exp(u[k]);
  return values;
}

VectorXd Coordinates::slope(const VectorXd& values) const {
  VectorXd slope = VectorXd::Ones(values.size());
  for (Index k = 0; k < values.size(); ++k)
    if (is_log(k)) slope[k] = values[k];
  return slope;
}

VectorXd Coordinates::scale(const VectorXd& u) const {
  VectorXd scale = VectorXd::Ones(u.size());
  for (Index k = 0; k < u.size(); ++k) {
    if (is_log(k)) continue;
    const double width = upper[k] - lower[k];
    scale[k] = u[k] != 0.0 ? std::abs(u[k]) : std::isfinite(width) ? width : 1.0;
  }
  return scale;
}

std::vector<Index> Coordinates::columns(Index run) const {
  std::vector<Index> columns;
  for (Index k = 0; k < size(); ++k)
    if (place(k).is_in(run)) columns.push_back(k);
  return columns;
}

std::vector<NamedValue> Coordinates::named(const VectorXd& u) const {
  const VectorXd values = outer(u);
  std::vector<NamedValue> all;
  for (Index k = 0; k < u.size(); ++k) all.push_back({place(k).label, values[k]});
  return all;
}

FitProblem::FitProblem(std::vector<Trial> all, Coordinates where, double tolerance)
    : trials(std::move(all)), coordinates(std::move(where)), rtol(tolerance) {
  Index size = 0, at = 0;
  for (const Trial& trial : trials) size += trial.data().size();
  data.resize(size), sigma.resize(size);
  for (const Trial& trial : trials) {
    const Index n = trial.data().size();
    data.segment(at, n) = trial.data(), sigma.segment(at, n) = trial.sigma();
    at += n;
  }
}

const FitPoint* FitProblem::at(const VectorXd& u) {
  if (last_ && last_->u == u) return &*last_;
  if (best && best->u == u) return &*best;
  ++record.evaluations;
  auto point = computed(u);
  const bool found = point.has_value();
  if (found) {
    last_ = std::move(point);
    if (!best || last_->residuals.squaredNorm() < best->residuals.squaredNorm()) best = *last_;
  }
  seen();
  return found ? &*last_ : nullptr;
}

std::optional<FitPoint> FitProblem::computed(const VectorXd& u) {
  const VectorXd values = coordinates.outer(u);
  FitPoint point{u, VectorXd(data.size()), MatrixXd::Zero(data.size(), u.size())};
  std::vector<std::string> reasons;
  Index row = 0;
  try {
    for (std::size_t k = 0; k < trials.size(); ++k) {
      const auto run = static_cast<Index>(k);
      const Evaluation found = trials[k].evaluate(of_run(values, run));
      const Index n = found.model.values.size();
      point.residuals.segment(row, n) = found.model.values;
      const std::vector<Index> columns = coordinates.columns(run);
      for (std::size_t c = 0; c < columns.size(); ++c)
        point.jacobian.col(columns[c]).segment(row, n) =
            found.model.derivatives.col(static_cast<Index>(c));
      add_once(reasons, found.reasons);
      row += n;
    }
    point.residuals = (point.residuals - data).cwiseQuotient(sigma);
    if (!std::isfinite(point.residuals.squaredNorm()))
      throw RunFailed("the sum of the squares of the residuals overflows");
  } catch (const RunFailed& error) {
    note(error);
    return {};
  }
  point.jacobian =
      sigma.cwiseInverse().asDiagonal() * point.jacobian * coordinates.slope(values).asDiagonal();
  replace_gaps(point, reasons);
  return point;
}

void FitProblem::note(const RunFailed& error) {
  failed = error;
  ++record.failures;
  if (record.first_failure.empty()) record.first_failure = error.what();
}

/// Differences of runs take the places in which derivatives are NaN.
void FitProblem::replace_gaps(FitPoint& point, const std::vector<std::string>& reasons) {
  for (Index k = 0; k < point.u.size(); ++k) {
    if (point.jacobian.col(k).allFinite()) continue;
    const std::string& label = coordinates.place(k).label;
    ++record.differences[label];
    add_once(record.reasons, reasons);
    const auto slope = difference(point, k);
    if (!slope) ++record.no_slope[label];
    for (Index i = 0; i < point.residuals.size(); ++i)
      if (!std::isfinite(point.jacobian(i, k))) point.jacobian(i, k) = slope ? (*slope)[i] : 0.0;
  }
}

/// The derivative of the residuals by one number: central within the bounds, else one-sided. Empty if
/// the runs on both sides fail.
std::optional<VectorXd> FitProblem::difference(const FitPoint& point, Index column) {
  // a step of log p is a relative one
  const double size = coordinates.is_log(column) ? 1.0 : point.u[column];
  const double step = difference_step(size, rtol);
  std::vector<std::pair<double, VectorXd>> sides;
  for (const double sign : {1.0, -1.0}) {
    VectorXd moved = point.u;
    moved[column] += sign * step;
    const double at = moved[column];
    if (at < coordinates.lower[column] || at > coordinates.upper[column]) continue;
    if (auto found = predicted(moved)) sides.emplace_back(at, std::move(*found));
  }
  if (sides.empty()) return {};
  if (sides.size() == 1) sides.emplace_back(point.u[column], point.residuals);
  return VectorXd((sides[0].second - sides[1].second) / (sides[0].first - sides[1].first));
}

std::optional<VectorXd> FitProblem::predicted(const VectorXd& u) {
  const VectorXd values = coordinates.outer(u);
  VectorXd model(data.size());
  Index row = 0;
  try {
    for (std::size_t k = 0; k < trials.size(); ++k) {
      const VectorXd part = trials[k].predict(of_run(values, static_cast<Index>(k)));
      model.segment(row, part.size()) = part;
      row += part.size();
    }
  } catch (const RunFailed&) {
    return {};
  }
  const VectorXd moved = (model - data).cwiseQuotient(sigma);
  return moved.allFinite() ? std::optional(moved) : std::nullopt;
}

/// The way down the gradient along the parameters that are not at a bound; zero if it is flat.
VectorXd FitProblem::descent_of(const FitPoint& point) const {
  const VectorXd slope = point.jacobian.transpose() * point.residuals;
  const double length = point.residuals.norm();
  VectorXd way = VectorXd::Zero(point.u.size());
  double largest = 0.0;
  for (Index k = 0; k < way.size(); ++k) {
    const double column = point.jacobian.col(k).norm(), size = std::abs(point.u[k]);
    const double next = point.u[k] - (slope[k] > 0.0 ? jump_near : -jump_near) * size;
    const bool inside = next > coordinates.lower[k] && next < coordinates.upper[k];
    if (!inside || !(std::abs(slope[k]) > steep_cosine * length * column)) continue;
    way[k] = -slope[k] / (column * column);
    largest = std::max(largest, std::abs(way[k]) / std::max(size, least_scale));
  }
  return largest > 0.0 ? VectorXd(way / largest) : way;
}

bool FitProblem::meets_jump(const FitPoint& point) {
  const double noise = rtol * data.cwiseQuotient(sigma).norm(), length = point.residuals.norm();
  if (length <= 10.0 * noise) return false;
  const VectorXd way = descent_of(point);
  if (way.isZero(0.0)) return false;
  double change[2] = {};
  for (const int i : {0, 1}) {
    const VectorXd moved = (point.u + (i == 0 ? jump_far : jump_near) * way)
                               .cwiseMax(coordinates.lower)
                               .cwiseMin(coordinates.upper);
    const auto found = predicted(moved);
    if (!found) return true;
    nth(change, i) = std::abs(found->squaredNorm() - length * length);
  }
  return change[1] > 0.1 * change[0] && change[1] > 10.0 * noise * length;
}

}  // namespace saltus
