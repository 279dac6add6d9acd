// Residuals and their Jacobian for the optimizer, from the runs of all experiments.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit_trial.hpp"

namespace saltus {

/// A parameter of a fit, with the experiment that it belongs to; -1: all of them.
struct FitPlace {
  std::string label;  ///< the name in the result
  std::string name;   ///< the name in a context
  FreeValue free;
  ContextEntry entry;
  Index run = -1;

  bool is_in(Index experiment) const { return run < 0 || run == experiment; }
};

/// Values u of the optimizer for values p of parameters: u = p, or u = log p.
class Coordinates {
 public:
  explicit Coordinates(std::vector<FitPlace> places);

  Index size() const noexcept { return start.size(); }
  const FitPlace& place(Index k) const { return places_[static_cast<std::size_t>(k)]; }
  bool is_log(Index k) const { return place(k).free.log; }

  double inner(Index k, double value) const;
  Eigen::VectorXd outer(const Eigen::VectorXd& u) const;
  /// dp/du at values p.
  Eigen::VectorXd slope(const Eigen::VectorXd& values) const;
  /// The unit in which the optimizer counts each number: its size at the start, or the width of its
  /// bounds, or 1. That of a logarithm is 1.
  Eigen::VectorXd scale(const Eigen::VectorXd& u) const;
  /// The positions of the parameters of one experiment.
  std::vector<Index> columns(Index run) const;
  /// The values with their labels.
  std::vector<NamedValue> named(const Eigen::VectorXd& u) const;

  Eigen::VectorXd start, lower, upper;

 private:
  std::vector<FitPlace> places_;
};

/// Residuals r = (model - data) / sigma and dr/du at one place u of the optimizer.
struct FitPoint {
  Eigen::VectorXd u, residuals;
  Eigen::MatrixXd jacobian;
};

/// What happened during a fit.
struct FitRecord {
  int evaluations = 0, failures = 0;
  std::string first_failure = {};
  /// Parameter -> Jacobians in which differences of runs replace derivatives, and those in which even
  /// the runs of a difference failed.
  std::map<std::string, int> differences = {}, no_slope = {};
  std::vector<std::string> reasons = {};  ///< why there was no derivative
};

/// Least squares over all experiments. The run that gives the residuals of a point gives its Jacobian
/// too.
class FitProblem {
 public:
  FitProblem(std::vector<Trial> trials, Coordinates coordinates, double rtol);

  /// The point at `u`; null if a run fails. It holds until the next call.
  const FitPoint* at(const Eigen::VectorXd& u);
  /// The residuals at `u` by runs without derivatives; empty if a run fails.
  std::optional<Eigen::VectorXd> predicted(const Eigen::VectorXd& u);
  /// Whether the cost at a point has a gradient, and a jump or a failing run right behind it.
  bool meets_jump(const FitPoint& point);
  /// The values that one experiment has.
  Eigen::VectorXd of_run(const Eigen::VectorXd& values, Index run) const {
    return values(coordinates.columns(run));
  }

  std::vector<Trial> trials;
  Coordinates coordinates;
  double rtol;
  Eigen::VectorXd data, sigma;
  FitRecord record;
  std::optional<RunFailed> failed;     ///< the last failure
  std::optional<FitPoint> best;        ///< with the least sum of squares
  std::function<void()> seen = [] {};  ///< after each evaluation

 private:
  std::optional<FitPoint> computed(const Eigen::VectorXd& u);
  void note(const RunFailed& error);
  void replace_gaps(FitPoint& point, const std::vector<std::string>& reasons);
  std::optional<Eigen::VectorXd> difference(const FitPoint& point, Index column);
  Eigen::VectorXd descent_of(const FitPoint& point) const;

  std::optional<FitPoint> last_;
};

}  // namespace saltus
