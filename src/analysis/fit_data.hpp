// The data of one experiment, with the signals, the span and the values of its run.
#pragma once

#include <string>
#include <vector>

#include "saltus/analysis/fit.hpp"

namespace saltus {

/// The values of a run in place of the data, and their derivatives: (data, parameters).
struct FitModel {
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;  ///< NaN where there is none
};

/// The finite data of one signal or event, in one row of numbers.
struct Observed {
  std::string name;
  bool is_event = false;
  std::string recorded = {};           ///< the name under which the run records the signal
  std::optional<EventKind> kind = {};  ///< of an event
  Eigen::VectorXd time, data, sigma;
  std::vector<Index> row = {};    ///< the row of the run for each value of a signal
  std::vector<Index> entry = {};  ///< the entry of the signal, or the number of the event
  double end = 0.0;  ///< [s] of the run, where an event is taken that the run does not have

  /// `count` parameters: 0 for a run without derivatives.
  FitModel model(const Results& results, Index count) const;
};

/// An experiment whose names are those of a system.
struct BoundExperiment {
  std::string where;  ///< the begin of a message about it
  std::string name;
  Context context;  ///< with the values of the experiment
  TimeSpan span;
  RecordedSignals recorded;
  std::vector<double> times;  ///< [s] of the rows: increasing
  std::vector<Observed> observed;
  std::vector<std::string> without_sigma = {};
  Index missing = 0;  ///< data that are NaN
};

/// Finds everything that an experiment names, and checks its data. Throws ModelError for what there is
/// not.
BoundExperiment bound_experiment(const System& system, const Experiment& experiment,
                                 const std::string& name, const Context& context,
                                 const FitOptions& options);

}  // namespace saltus
