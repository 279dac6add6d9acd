// The operating point at the end of a search, with what limits it.
#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/detail/eigenvalues.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "trim_search.hpp"

namespace saltus {

namespace {

struct CrossedGuard {
  std::string name;
  double before = 0.0, after = 0.0;
};

/// A second point close to the first; empty if it is not in the domain.
std::optional<TrimPoint> beside(TrimProblem& problem, const TrimPoint& point,
                                const TrimScales& scales, const Eigen::VectorXd& upper) {
  const Eigen::VectorXd step = beside_point * scales.largest();
  Eigen::VectorXd values = point.values + step;
  for (Index k = 0; k < values.size(); ++k)
    if (values[k] > upper[k]) values[k] = point.values[k] - step[k];
  return problem.tried(values);
}

double largest_real(const Eigen::MatrixXd& a) { return detail::eigenvalues(a).real().maxCoeff(); }

/// [1/s] What a real part of a pole has to exceed: its error, and its change to the other point with
/// that of the entries of A.
double margin_of(const TrimPoint& point, const std::optional<TrimPoint>& other) {
  const Eigen::MatrixXd& a = point.matrices.A;
  if (a.size() == 0) return 0.0;
  const double change = other ? std::abs(largest_real(a) - largest_real(other->matrices.A)) : 0.0;
  return std::max(pole_margin * a.cwiseAbs().maxCoeff(), change);
}

/// The rank of the Jacobian, and the unknowns that its null space moves. A singular value below the
/// change of the Jacobian to the other point counts as zero.
std::pair<int, List<Index>> undetermined_by(const TrimPoint& point,
                                            const std::optional<TrimPoint>& other,
                                            const TrimScales& scales) {
  const Eigen::VectorXd units = scales.largest();
  Eigen::VectorXd rows = point.jacobian.cwiseAbs() * units;
  if (other) rows = rows.cwiseMax(other->jacobian.cwiseAbs() * units);
  rows = (rows.array() > 0.0).select(rows, 1.0).cwiseInverse();
  const auto scaled = [&](const Eigen::MatrixXd& of) -> Eigen::MatrixXd {
    return rows.asDiagonal() * of * units.asDiagonal();
  };
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled(point.jacobian), Eigen::ComputeFullV);
  double least = rank_of_point * svd.singularValues()[0];
  if (other)
    least =
        std::max(least, scaled(other->jacobian - point.jacobian).jacobiSvd().singularValues()[0]);
  const auto rank = static_cast<int>((svd.singularValues().array() > least).count());
  const Eigen::VectorXd moved = svd.matrixV().rightCols(units.size() - rank).rowwise().norm();
  List<Index> lost;
  for (Index k = 0; k < moved.size(); ++k)
    if (rank < units.size() && moved[k] > null_part) lost.push_back(k);
  return {rank, lost};
}

bool crosses(double before, double after, Direction direction) {
  const bool any = direction == Direction::crosses_zero;
  const bool falls = any || direction == Direction::positive_then_non_positive;
  const bool rises = any || direction == Direction::negative_then_non_negative;
  return (before < 0.0 && after > 0.0 && rises) || (before > 0.0 && after < 0.0 && falls);
}

/// The guards with an effect whose value changed its sign in their direction.
std::vector<CrossedGuard> crossed_guards(const TrimPoint& first, const TrimPoint& end) {
  std::vector<CrossedGuard> crossed;
  for (std::size_t i = 0; i < first.matrices.guards.size(); ++i) {
    const GuardValue& before = first.matrices.guards[i];
    const double after = end.matrices.guards[i].value;
    if (crosses(before.value, after, before.direction))
      crossed.push_back({before.name, before.value, after});
  }
  return crossed;
}

std::string without_prefix(std::string message) {
  constexpr std::string_view prefix = "linearize: ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

/// Why there is no linearisation at the point; empty if there is one.
std::string kink_at(TrimProblem& problem, const TrimSetting& setting) {
  try {
    problem.reader.at(setting, false);
  } catch (const ModelError& error) {
    return without_prefix(error.what());
  }
  return {};
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

/// Which equation does not hold, and what to do.
std::string reason_of(const TrimProblem& problem, const TrimFound& found,
                      const std::vector<std::string>& at_bounds) {
  Index worst = 0;
  found.point.residual.cwiseQuotient(found.scales.rows).cwiseAbs().maxCoeff(&worst);
  const TrimTarget& target = nth(problem.targets, worst);
  const std::string said =
      text("t = ", found.point.matrices.time, " s: '", target.name, "' is ",
           target.value + found.point.residual[worst], ", expected ", target.value);
  if (found.status == SearchStatus::max_nfev)
    return said + "; the limit of evaluations was reached: give a larger max_nfev";
  const std::string held =
      at_bounds.empty() ? "" : text(" with ", joined(at_bounds), " at a bound");
  const std::string failed =
      problem.failed.empty() ? "" : text("; an evaluation failed: ", problem.failed);
  return text(said, "; no step makes the residuals smaller", held,
              ": free more values, widen bounds, or begin elsewhere", failed);
}

void add_notes(OperatingPoint& point, const std::vector<CrossedGuard>& crossed,
               const std::string& kink) {
  for (const CrossedGuard& guard : crossed) {
    point.crossed.push_back(guard.name);
    point.notes.push_back(text(
        "the guard '", guard.name, "' has an effect and lies between the start (g = ", guard.before,
        ") and this point (g = ", guard.after, "): a run that comes here leaves the mode"));
  }
  if (!point.undetermined.empty())
    point.notes.push_back(text("the equations do not determine ", joined(point.undetermined),
                               " (rank ", point.rank, ")"));
  if (!kink.empty()) point.notes.push_back(kink);
  point.smooth = kink.empty();
}

}  // namespace

OperatingPoint outcome_of(TrimProblem& problem, const TrimFound& found, const TrimBounds& bounds) {
  const TrimPoint& end = found.point;
  const TrimSetting setting = problem.setting.put(problem.places, end.values);
  const auto other = beside(problem, end, found.scales, bounds.upper);
  OperatingPoint point;
  point.context = setting.context, point.inputs = setting.inputs;
  const auto [rank, lost] = undetermined_by(end, other, found.scales);
  point.rank = rank;
  for (Index k = 0; k < end.values.size(); ++k) {
    const std::string& name = nth(problem.places, k).name;
    point.values.push_back({name, end.values[k]});
    const double near = std::min(std::abs(end.values[k] - bounds.lower[k]),
                                 std::abs(bounds.upper[k] - end.values[k]));
    if (near <= close_to_bound * found.scales.unknowns[k]) point.at_bounds.push_back(name);
  }
  for (const Index k : lost) point.undetermined.push_back(nth(problem.places, k).name);
  for (Index i = 0; i < end.residual.size(); ++i)
    point.residuals.push_back({nth(problem.targets, i).name, end.residual[i]});
  point.status = found.status;
  if (!point.success()) point.message = reason_of(problem, found, point.at_bounds);
  add_notes(point, crossed_guards(found.first, end), kink_at(problem, setting));
  point.margin = margin_of(end, other), point.linearization = end.matrices;
  point.evaluations = problem.evaluations;
  return point;
}

}  // namespace saltus
