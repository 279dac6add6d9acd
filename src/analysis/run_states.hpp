// The states of a system as one vector, and their derivatives in a run.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "saltus/simulation/results.hpp"

namespace saltus {

/// The continuous states of a system, and after them its discrete states, with the names that the
/// option `sensitivity` knows: "x[0]", "ball.z[1]".
class RunStates {
 public:
  explicit RunStates(const Context& context);

  const std::vector<std::string>& names() const noexcept { return names_; }
  const std::string& name(Index i) const { return names_[static_cast<std::size_t>(i)]; }
  Index size() const noexcept { return static_cast<Index>(names_.size()); }
  Index continuous() const noexcept { return continuous_; }
  /// The paths of the blocks, for the modes of a context.
  const std::vector<std::string>& blocks() const noexcept { return blocks_; }

  /// The values of all states in a context.
  static Eigen::VectorXd of(const Context& context);
  /// The context with these states.
  Context put(const Context& context, const Eigen::VectorXd& values) const;

 private:
  std::vector<std::string> names_, blocks_;
  Index continuous_ = 0;
};

/// Derivatives of the final context at a fixed time: continuous states, then discrete ones, by the
/// parameters of the run.
Eigen::MatrixXd derivatives_of(const Results& results);

/// The numbers of the events of a log that a name and a kind mean, as EventLog::times chooses them.
/// Throws ModelError for an unknown name.
std::vector<std::size_t> events_called(const EventLog& log, const std::string& name,
                                       std::optional<EventKind> kind = {});
/// (events, parameters) [s per unit] the derivatives of the times of these events; of zeno_enter
/// those of the predicted time.
Eigen::MatrixXd event_derivatives(const Results& results, const std::string& name,
                                  std::optional<EventKind> kind = {});

/// Throws SimulationError if a derivative by one of the names is NaN, with its event and time.
/// `values` has a column for each name.
void refuse_gap(const std::string& where, const Results& results,
                const std::vector<std::string>& names, const Eigen::MatrixXd& values);

/// The names of the continuous states that a Zeno hold keeps at rest; empty if all move.
std::vector<std::string> at_rest(const Context& context, const RunStates& states);

/// "'a', 'b'" of any number of names.
std::string quoted(const std::vector<std::string>& names);

}  // namespace saltus
