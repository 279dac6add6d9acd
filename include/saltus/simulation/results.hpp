// Results: the values that a run returns.
#pragma once

#include <cstdint>
#include <exception>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/dense_output.hpp"
#include "saltus/simulation/dense_sensitivities.hpp"
#include "saltus/simulation/event_log.hpp"
#include "saltus/solver/statistics.hpp"

namespace saltus {

enum class Status { reached_end, terminal, zeno_stop, step_limit, chattering, interrupted, failed };

inline std::string_view to_string(Status status) {
  constexpr std::string_view names[] = {"reached_end", "terminal",    "zeno_stop", "step_limit",
                                        "chattering",  "interrupted", "failed"};
  return nth(names, status);
}
/// Whether a run ended well, which it can in three ways.
constexpr bool ended_well(Status status) { return status <= Status::zeno_stop; }

/// Counts, summed over the whole run.
struct Statistics : SolverStatistics {
  std::int64_t right_hand_side_calls = 0;
  std::int64_t guard_calls = 0;  ///< each call computes all guards
  std::int64_t jacobian_calls = 0;
  std::int64_t events = 0;    ///< resets, updates and mode changes
  std::int64_t instants = 0;  ///< major steps
  std::vector<std::pair<std::string, std::int64_t>> events_by_name = {};
  double wall_time = 0.0;  ///< [s]
  std::string method = {};
  std::vector<Stretch> stretches = {};  ///< the method of each stretch of time: more than one with
                                        ///< "auto" only
};

/// One recorded signal: one row for each time, row major.
struct RecordedSignal {
  std::string name;
  Shape shape;
  std::vector<double> values;
  int island = -1;  ///< the island whose rows it has; -1: the rows of Results::time

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<const Matrix> matrix() const {
    return {values.data(), shape.size > 0 ? static_cast<Index>(values.size()) / shape.size : 0,
            shape.size};
  }
};

/// One island of a run with the option islands.
struct IslandResults {
  std::string name;          ///< the path of its first block
  std::size_t blocks = 0;    ///< how many blocks it has
  std::vector<double> time;  ///< [s] of its rows; never decreases
  std::vector<int> jump;     ///< j of each row, counted in this island alone
  Statistics statistics;
};

struct Results {
  /// [s] Never decreases. Empty if islands stepped apart, unless all signals have one table: with
  /// save_at and event_rows = false.
  std::vector<double> time;
  std::vector<int> jump;  ///< j of each row, which tells rows of equal time apart
  std::vector<RecordedSignal> signals;
  /// The islands that stepped apart, each with the rows of its signals; otherwise empty.
  std::vector<IslandResults> islands;
  EventLog events;
  Context context;  ///< the values at the end; a run can continue from here
  Status status = Status::reached_end;
  std::string message;       ///< the reason, if the status is not a good one
  std::string block;         ///< the block at fault, if it was one block
  std::exception_ptr cause;  ///< the exception, if the status is failed
  Statistics statistics;
  Sensitivities sensitivities;  ///< with the option sensitivity; otherwise empty
  Trajectory trajectory;        ///< with the option dense_output; otherwise empty

  /// The continuous state and every recorded signal at any time of a run with the option
  /// dense_output, to the order of its method. At the time of an event they are the values after
  /// it, with Side::left before it. The system must still exist. For many times use one
  /// DenseOutput. Throws ModelError for a time outside the run, and for a run without that option.
  Moment at(double t, Side side = Side::right) const;
  /// The derivatives of these values at that fixed time, of a run with the options sensitivity and
  /// dense_output. At the time of an event they are those after it, with Side::left before it: they
  /// differ by the jump that the moving event makes. At a recorded row they are those of the row.
  /// For many times use one DenseSensitivities. Throws ModelError as `at` does.
  MomentSensitivities sensitivities_at(double t, Side side = Side::right) const;

  /// A recorded signal by name, rows by width; a ModelError lists the names there are.
  Eigen::Map<const RecordedSignal::Matrix> output(std::string_view name) const;
  /// [s] The times of the rows of a recorded signal: those of its island, or `time`.
  const std::vector<double>& time_of(std::string_view name) const;
  /// The same for one of `signals`, without a search.
  const std::vector<double>& time_of(const RecordedSignal& signal) const;
  /// j of the rows of a recorded signal: that of its island, or `jump`.
  const std::vector<int>& jump_of(std::string_view name) const;

 private:
  const RecordedSignal& signal(std::string_view name) const;
};

/// Writes some ten lines: the status with its reason, the rows, the recorded signals, the events by
/// name, what rests, the steps and calls, and the time that the run took. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const Results& results);

}  // namespace saltus
