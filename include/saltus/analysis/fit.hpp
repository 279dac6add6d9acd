// fit: parameters and start values of a system from measured data.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/analysis/experiment.hpp"

namespace saltus {

/// The loss rho(z) of z = (r / f_scale)^2: z; 2 (sqrt(1 + z) - 1); z or 2 sqrt(z) - 1 beyond 1;
/// ln(1 + z); arctan(z).
enum class Loss { linear, soft_l1, huber, cauchy, arctan };

std::string_view to_string(Loss loss);
/// Throws ModelError for an unknown name, with the nearest.
Loss loss_from(std::string_view name);

/// How far a fit has come, after each evaluation.
struct FitProgress {
  int evaluations = 0;
  double sum_of_squares = 0.0;         ///< the least so far; infinite before the first
  std::vector<NamedValue> parameters;  ///< of that
  int failures = 0;
  int start = 0, starts = 1;  ///< the number of the present start, from 0, and of all
};

struct FitOptions {
  /// [s] Begin and end of each run. Empty: it begins at the time of the context and ends at the last
  /// time of the data, or with event times at twice the time to the last of them.
  std::optional<TimeSpan> t_span = {};
  /// The standard deviation of all signals that have none of their own; 1 by default. The weight of a
  /// value is 1 / sigma^2.
  std::optional<double> sigma = {};
  /// The values of sigma are known as numbers. False: only their ratios count, and the covariance is
  /// scaled by sum r^2 / (n - p).
  bool absolute_sigma = false;
  Loss loss = Loss::linear;
  double f_scale = 1.0;  ///< the residual at which it begins to count less, in units of sigma
  /// The number of starts; those after the first are drawn by a Latin hypercube within the bounds. The
  /// best is the result.
  int starts = 1;
  double seed = 0.0;                 ///< of the drawn starts: any finite number
  std::optional<int> max_nfev = {};  ///< evaluations of each start; empty: 100 for each parameter
  double ftol = 1e-8;  ///< a step that changes the cost by this part of it is the last
  double xtol = 1e-8;  ///< as is a step of this part of the length of the parameters
  /// Called after each evaluation.
  std::function<void(const FitProgress&)> progress = {};
  /// The options of each run. Change single ones, so that the tight tolerances stay. Its `interrupt`
  /// ends the fit too.
  SimulatorOptions simulation = {.rtol = 1e-8, .atol = 1e-10};
};

/// The data of one name in one experiment, beside the values of the fitted run.
struct Compared {
  std::string experiment, name;
  bool is_event = false;
  std::vector<Index> entry;  ///< the entry of the signal, or the number of the event, of each value
  Eigen::VectorXd time;      ///< [s]
  Eigen::VectorXd data, model;
  Eigen::VectorXd residual;  ///< (model - data) / sigma
};

/// The outcome of one start of a fit.
struct FitStart {
  std::vector<NamedValue> start, parameters;  ///< where it began, and where it ended
  double cost = 0.0;                          ///< infinite if its first run failed
  SearchStatus status = SearchStatus::converged;
  std::string message;
  int evaluations = 0;
};

/// What `fit` found.
struct FitResult {
  std::vector<NamedValue> parameters;  ///< the fitted values
  /// Of the parameters, in their order; a parameter that the data do not determine has the variance
  /// infinity, and NaN beside it.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residuals;  ///< (model - data) / sigma, in the order of `compared`
  Eigen::MatrixXd jacobian;   ///< of the residuals by the parameters: (data, parameters)
  double cost = 0.0;          ///< half the sum of the squares of the residuals, or of their losses
  /// Converged; max_nfev; stalled: no shorter step helped, and the gradient is not zero, as the cost
  /// jumps there; or interrupted.
  SearchStatus status = SearchStatus::converged;
  std::string message;                ///< the reason for the status
  std::vector<std::string> warnings;  ///< what to know before the values are used
  std::vector<Results> runs;       ///< of each experiment with the fitted values, with dense output
  std::vector<Context> contexts;   ///< the values at the begin of these runs
  std::vector<Compared> compared;  ///< for each signal and event of each experiment
  int missing = 0;                 ///< data that were NaN, and so did not count
  int evaluations = 0;        ///< points at which all experiments were run, in all starts; those of
                              ///< differences do not count
  int failures = 0;           ///< evaluations that failed, and shortened a step
  std::string first_failure;  ///< the message of the first of them
  std::vector<FitStart> starts;  ///< every start; the fit is the best of them
  double wall_time = 0.0;        ///< [s]

  bool success() const noexcept { return status == SearchStatus::converged; }
  /// A fitted value, by its name; a ModelError lists the names there are.
  double value(std::string_view name) const;
  /// The standard error of each parameter; infinite if the data do not determine it.
  Eigen::VectorXd standard_errors() const;
  /// The correlation of the parameters; NaN where there is none.
  Eigen::MatrixXd correlation() const;
  /// The confidence interval of each parameter: value -+ t standard error, with the quantile t of
  /// Student's distribution with n - p degrees of freedom, or with `absolute_sigma` that of the normal
  /// distribution. Of a logarithm it is that of the logarithm. It belongs to the linearised model:
  /// bounds do not enter it. Throws ModelError unless 0 < level < 1.
  std::vector<std::pair<double, double>> confidence(double level = 0.95) const;

  // --- for the engine ---
  std::vector<bool> logarithms = {};  // of the parameters
  double freedom = 0.0;               // degrees; infinite for the normal distribution
};

/// Writes the status, the parameters with their errors, and the warnings. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const FitResult& fit);

/// Parameters and start values of a system from measured data, by least squares. It finds the p within
/// the bounds with the least
///
///     1/2 sum r_i(p)^2,  r_i = (model_i(p) - data_i) / sigma_i
///
/// by detail/least_squares.hpp. The Jacobian dr/dp comes from the option `sensitivity` of the same
/// run, also through events and for event times. The covariance is s^2 (J^T J)^-1; with another loss
/// that of P. Huber, 5th Berkeley Symposium 1 (1967) 221. A run that fails at the values of a step
/// makes the step shorter, and is counted in `failures`. Where a run has no derivative, differences of
/// runs take its place, and `warnings` says so.
///
/// Throws ModelError before any run: for unknown parameters, signals and events (the message has the
/// nearest name), options that a fit sets itself, data outside of the run or of the wrong shape, fewer
/// data than parameters, a start outside of its bounds. SimulationError if the run with the start
/// values fails, with the results until then.
FitResult fit(const System& system, const Context& context, const std::vector<Experiment>& data,
              const std::vector<FreeValue>& parameters, const FitOptions& options = {});
/// The same with the data of one run.
FitResult fit(const System& system, const Context& context, const Experiment& data,
              const std::vector<FreeValue>& parameters, const FitOptions& options = {});

}  // namespace saltus
