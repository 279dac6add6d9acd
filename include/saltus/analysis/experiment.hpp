// Experiment: measured data of one run, and the values under which they were measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saltus/analysis/free_value.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

/// The measured values of one signal.
struct MeasuredSignal {
  /// An output of the system, "y", or an entry of a vector or a matrix, "y[1]", "y[0,1]". With a port
  /// a name of your choice, also with an entry behind it.
  std::string name = {};
  /// A row for each time, a column for each entry, those of a matrix row by row. NaN is a missing
  /// value. At the time of an event a signal has its value after the event.
  Eigen::MatrixXd values = {};
  OutputPort port = {};  ///< of a block in the system; without it the name is one of the system's
  /// The standard deviations: one for all, one for each time, or the shape of the values. Empty: that
  /// of the options, or 1.
  Eigen::MatrixXd sigma = {};
};

/// Measured times of an event. The k-th time belongs to the k-th event of the run; more events of the
/// run do not count. An event that the run does not have is taken at the end of the run, so that the
/// residual is continuous where an event leaves the run; or at the predicted Zeno time, if the events
/// accumulated there.
struct MeasuredEvents {
  std::string name = {};               ///< "ball.bounce" or "bounce"
  std::vector<double> times = {};      ///< [s] increasing; NaN for an event that was not seen
  std::vector<double> sigma = {};      ///< [s] one for all, or one for each; empty: 1
  std::optional<EventKind> kind = {};  ///< as in EventLog::times; of zeno_enter the data are the
                                       ///< predicted times of infinitely many events
};

/// Data of one run.
struct Experiment {
  std::vector<double> time = {};  ///< [s] of the rows of the signals, in any order
  std::vector<MeasuredSignal> signals = {};
  std::vector<MeasuredEvents> events = {};
  std::optional<Context> context = {};  ///< at the begin of the run; empty: that of `fit`
  /// Values of parameters and start values that hold in this experiment.
  std::vector<NamedValue> values = {};
  /// Parameters and start values that are fitted for this experiment alone; their names in the result
  /// begin with that of the experiment: "drop 2: x[0]".
  std::vector<FreeValue> free = {};
  std::optional<TimeSpan> t_span = {};  ///< [s] empty: that of the options
  std::string name = {};                ///< in the result; empty: "run 1", "run 2", ...
};

}  // namespace saltus
