// The runs of one experiment: a simulator that is used for all of them.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fit_data.hpp"
#include "saltus/model/context_entry.hpp"

namespace saltus {

/// A run that gives no residuals; the fit goes on with a shorter step.
struct RunFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
  std::shared_ptr<const Results> results = {};
};

/// The option `interrupt` has ended a run, and with it the fit.
struct FitStopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter of a run: its name in the context.
struct TrialParameter {
  std::string name;
  ContextEntry entry;
};

/// The values of one run, in the order of the data, and what was missing.
struct Evaluation {
  FitModel model;
  std::vector<std::string> reasons = {};  ///< why derivatives are missing
};

class Trial {
 public:
  Trial(const System& system, BoundExperiment bound, std::vector<TrialParameter> parameters,
        const SimulatorOptions& options);

  const BoundExperiment& bound() const noexcept { return bound_; }
  const Eigen::VectorXd& data() const noexcept { return data_; }
  const Eigen::VectorXd& sigma() const noexcept { return sigma_; }

  /// The context at the begin of a run with these values.
  Context start(const Eigen::VectorXd& values) const;
  /// The run with these values in place of the data. Throws RunFailed if it gives none.
  Evaluation evaluate(const Eigen::VectorXd& values);
  /// The same without derivatives.
  Eigen::VectorXd predict(const Eigen::VectorXd& values);
  /// A whole run with these values: every step and event, and dense output.
  Results show(const Eigen::VectorXd& values) const;

 private:
  void begin_with_derivatives(SimulatorOptions options);
  void require_events() const;
  FitModel model(const Results& results, Index count) const;
  const Results& run(Simulator& simulator, const Eigen::VectorXd& values);

  const System& system_;
  BoundExperiment bound_;
  std::vector<TrialParameter> parameters_;
  SimulatorOptions options_;
  std::shared_ptr<const Plan> plan_;
  std::optional<Simulator> plain_, derived_;
  std::string no_derivatives_;
  Eigen::VectorXd data_, sigma_;
};

}  // namespace saltus
