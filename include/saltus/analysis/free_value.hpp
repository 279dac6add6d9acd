// FreeValue: a number that a search may change, with its start value and its bounds.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace saltus {

/// A parameter, a start value or an open input that a search may change, by the names of
/// `Ensemble::vary` and `linearize`: "e", "ball.x[0]", "throttle".
///
///     {.name = "e", .start = 0.7, .lower = 0.1, .upper = 1.0}
struct FreeValue {
  std::string name = {};
  /// The value at which the search begins. Empty: that of the context, if it lies within the bounds,
  /// or otherwise the middle of the bounds.
  std::optional<double> start = {};
  double lower = -std::numeric_limits<double>::infinity();  ///< the search stays within the bounds
  double upper = std::numeric_limits<double>::infinity();
  /// The logarithm is searched for, so that the value stays positive and a step is a factor. Only
  /// `fit` takes it.
  bool log = false;
};

/// A number with the name of what it belongs to.
struct NamedValue {
  std::string name = {};
  double value = 0.0;
};

/// How a search ended.
enum class SearchStatus {
  converged,
  max_nfev,        ///< the limit of evaluations was reached
  max_iterations,  ///< the limit of Newton steps was reached
  stalled,         ///< no shorter step helped
  interrupted,     ///< by the option interrupt
  failed           ///< of one start among several: it has no value
};

std::string_view to_string(SearchStatus status);

namespace detail {

/// Throws ModelError for bounds or a start that make no sense. `where` begins the message.
void require_possible(const std::string& where, const FreeValue& free);
/// The same with a start: its own, or `value` of the context, or the middle of the bounds. A value at
/// a bound is no start, because the search could hardly leave it. Throws ModelError if there is none.
FreeValue with_start(const std::string& where, FreeValue free, double value);

/// Rows of `count` starts within the bounds: each value has one of them in each of `count` equal
/// parts of its bounds, a Latin hypercube (M. McKay, R. Beckman, W. Conover, Technometrics 21 (1979)
/// 239). The seed is any finite number.
std::vector<Eigen::VectorXd> latin_hypercube(const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper, int count, double seed);

}  // namespace detail

}  // namespace saltus
