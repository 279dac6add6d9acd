// Outcomes: the results of an ensemble's runs, as columns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saltus/simulation/ensemble.hpp"

namespace saltus {

/// One row for each run. A row of a run that failed, or was not made, has NaN for missing values.
class Outcomes {
 public:
  static constexpr int not_run = -1;

  /// Memory for the runs of `ensemble`. Recorded signals are kept at `times` [s], which the option
  /// save_at of the ensemble must contain; without times, at the end.
  explicit Outcomes(const Ensemble& ensemble, std::vector<double> times = {});

  /// Stores one run. Several threads may store different runs at once.
  void take(Index run, const Results& results);

  /// One recorded signal: for each run, at each time, `shape.size` values.
  struct Signal {
    std::string name;
    Shape shape;
    std::vector<double> values;
  };

  std::vector<double> times;                ///< [s] empty: signals at the end only
  std::vector<int> status;                  ///< a Status, or not_run
  std::vector<std::string> message, block;  ///< the reason and the block, if it did not end well
  std::vector<double> end_time;             ///< [s]
  std::vector<double> wall_time;            ///< [s]
  std::vector<std::int64_t> events, steps;  ///< their numbers
  std::vector<double> continuous_state;     ///< at the end, nx for each run
  std::vector<double> discrete_state;       ///< nz for each run
  std::vector<int> modes;                   ///< one for each block and run
  std::vector<Signal> signals;

 private:
  void take_signal(Signal& signal, const RecordedSignal& from, std::size_t run,
                   const std::vector<double>& rows) const;
};

}  // namespace saltus
