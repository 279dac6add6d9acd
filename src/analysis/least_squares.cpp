// Least squares within bounds.
#include "saltus/analysis/detail/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>

#include "saltus/analysis/detail/thresholds.hpp"

namespace saltus::detail {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Chosen = std::vector<Index>;

/// One descent.
class BoundedDescent {
 public:
  BoundedDescent(const LeastSquares& problem, const VectorXd& start, const VectorXd& lower,
                 const VectorXd& upper, const LeastSquaresLimits& limits)
      : problem_(problem), lower_(lower), upper_(upper), limits_(limits) {
    found_.x = start;
    const auto cost = evaluated(start);
    found_.cost = cost.value_or(std::numeric_limits<double>::infinity());
  }

  LeastSquaresFound run() {
    while (true) {
      linearise();
      if (steepest() <= limits_.gradient) return ended(LeastSquaresEnd::gradient);
      if (const auto end = step()) return ended(*end);
    }
  }

 private:
  LeastSquaresFound ended(LeastSquaresEnd end) {
    found_.end = end;
    return found_;
  }

  std::optional<double> evaluated(const VectorXd& x) {
    ++found_.evaluations;
    return problem_.cost(x);
  }

  void linearise() {
    problem_.linear(found_.x, residual_, jacobian_);
    gradient_ = jacobian_.transpose() * residual_;
    const VectorXd length = jacobian_.colwise().norm();
    scale_ = scale_.size() == 0 ? length : VectorXd(scale_.cwiseMax(length));
  }

  bool held(Index i) const {
    return (found_.x[i] <= lower_[i] && gradient_[i] >= 0.0) ||
           (found_.x[i] >= upper_[i] && gradient_[i] <= 0.0);
  }

  /// The largest cosine between the residuals and the column of a value that may move.
  double steepest() const {
    double largest = 0.0;
    for (Index i = 0; i < gradient_.size(); ++i) {
      const double size = jacobian_.col(i).norm() * residual_.norm();
      if (!held(i) && size > 0.0) largest = std::max(largest, std::abs(gradient_[i]) / size);
    }
    return largest;
  }

  /// A step that is tried, and the cost at its end.
  struct Trial {
    VectorXd x;
    bool small;        // beside the size of the values
    double predicted;  // the reduction of the cost by the linear problem
    double cost = 0.0, reduced = 0.0;
    double enough = 0.0;  // a smaller reduction is none
    double ratio() const { return reduced / predicted; }
  };

  /// A step to a lower cost; the reason if there is none, or if it was the last.
  std::optional<LeastSquaresEnd> step() {
    while (true) {
      Trial trial = proposed();
      if (!(trial.predicted > 0.0)) {
        if (trial.small || damping_ > most_damping) return LeastSquaresEnd::step;
      } else {
        if (found_.evaluations >= limits_.evaluations) return LeastSquaresEnd::evaluations;
        evaluate(trial);
        if (trial.ratio() > least_reduction) return taken(trial);
        if (const auto end = refused(trial)) return end;
      }
      harder();
    }
  }

  Trial proposed() const {
    const VectorXd x = (found_.x + within_bounds()).cwiseMax(lower_).cwiseMin(upper_);
    const VectorXd s = x - found_.x;
    return {.x = x,
            .small = length_of(s) <= limits_.step * length_of(found_.x),
            .predicted = -gradient_.dot(s) - 0.5 * (jacobian_ * s).squaredNorm()};
  }

  /// Where the problem has no cost, nothing is reduced.
  void evaluate(Trial& trial) {
    const auto cost = evaluated(trial.x);
    trial.cost = cost.value_or(std::numeric_limits<double>::infinity());
    trial.reduced = cost ? found_.cost - *cost : -std::numeric_limits<double>::infinity();
    trial.enough = limits_.cost * found_.cost;
  }

  /// Why the search ends at a step that reduces too little, if it does.
  static std::optional<LeastSquaresEnd> refused(const Trial& trial) {
    if (trial.predicted <= trial.enough && std::abs(trial.reduced) <= trial.enough)
      return LeastSquaresEnd::cost;
    if (trial.small) return LeastSquaresEnd::step;
    return {};
  }

  /// Takes a step, and says why it is the last, if it is.
  std::optional<LeastSquaresEnd> taken(const Trial& trial) {
    found_.x = trial.x, found_.cost = trial.cost;
    easier(trial.ratio());
    if (trial.reduced <= trial.enough && trial.ratio() > 0.25) return LeastSquaresEnd::cost;
    if (trial.small) return LeastSquaresEnd::step;
    return {};
  }

  double length_of(const VectorXd& x) const { return scale_.cwiseProduct(x).norm(); }

  void harder() {
    damping_ = std::max(damping_, least_damping) * growth_;
    growth_ = std::min(2.0 * growth_, most_growth);
  }

  void easier(double ratio) {
    damping_ *= std::max(shrinks_by, 1.0 - std::pow(2.0 * ratio - 1.0, 3.0));
    growth_ = 2.0;
  }

  /// The damped step, of which no part leads out of the bounds.
  VectorXd within_bounds() const {
    VectorXd s = VectorXd::Zero(found_.x.size());
    Chosen free;
    for (Index i = 0; i < s.size(); ++i)
      if (!held(i)) free.push_back(i);
    while (!free.empty()) {
      const VectorXd part = damped(free, residual_ + jacobian_ * s);
      Chosen inside;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const Index i = free[k];
        const double x = found_.x[i] + part[static_cast<Index>(k)];
        if (x < lower_[i] || x > upper_[i])
          s[i] = std::clamp(x, lower_[i], upper_[i]) - found_.x[i];
        else
          inside.push_back(i);
      }
      if (inside.size() == free.size()) {
        for (std::size_t k = 0; k < free.size(); ++k) s[free[k]] = part[static_cast<Index>(k)];
        break;
      }
      free = inside;
    }
    return s;
  }

  /// The s of least |r + J s|^2 + lambda |D s|^2 over some of the values.
  VectorXd damped(const Chosen& free, const VectorXd& residual) const {
    const Index m = residual.size(), n = static_cast<Index>(free.size());
    MatrixXd rows = MatrixXd::Zero(m + n, n);
    VectorXd unit(n);
    for (Index k = 0; k < n; ++k) {
      const Index i = free[static_cast<std::size_t>(k)];
      unit[k] = scale_[i] > 0.0 ? scale_[i] : 1.0;
      rows.col(k).head(m) = jacobian_.col(i) / unit[k];
      rows(m + k, k) = std::sqrt(damping_);
    }
    VectorXd wanted = VectorXd::Zero(m + n);
    wanted.head(m) = -residual;
    return rows.colPivHouseholderQr().solve(wanted).cwiseQuotient(unit);
  }

  const LeastSquares& problem_;
  const VectorXd &lower_, &upper_;
  const LeastSquaresLimits& limits_;
  LeastSquaresFound found_;
  VectorXd residual_, gradient_, scale_;
  MatrixXd jacobian_;
  double damping_ = first_damping, growth_ = 2.0;
};

}  // namespace

LeastSquaresFound least_squares(const LeastSquares& problem, const VectorXd& start,
                                const VectorXd& lower, const VectorXd& upper,
                                const LeastSquaresLimits& limits) {
  return BoundedDescent(problem, start.cwiseMax(lower).cwiseMin(upper), lower, upper, limits).run();
}

}  // namespace saltus::detail
