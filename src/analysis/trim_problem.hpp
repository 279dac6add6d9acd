// The residuals of a search for an operating point, with their Jacobian.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "places.hpp"
#include "saltus/analysis/trim.hpp"

namespace saltus {

/// All that the functions of a system read: a context, and the values of open inputs.
struct TrimSetting {
  Context context;
  std::vector<LinearInput> inputs;

  /// The same with these values.
  TrimSetting put(const std::vector<AnalysisPlace>& places, const Eigen::VectorXd& values) const;
};

/// One equation: the row `index` of the rates, or of the outputs, has this value.
struct TrimTarget {
  std::string name;  ///< "rate of angle", or "y[1]"
  bool is_rate = true;
  Index index = 0;
  double value = 0.0;
};

/// Linearisations of one system. A new value of an open input needs a new plan.
class TrimReader {
 public:
  TrimReader(const System& system, std::vector<std::string> parameters, RecordedSignals signals,
             std::shared_ptr<Refinement> refinement)
      : system_(&system),
        parameters_(std::move(parameters)),
        signals_(std::move(signals)),
        refinement_(std::move(refinement)) {}

  /// The rates, the outputs and their derivatives. At a kink those of the present side.
  Linearization at(const TrimSetting& setting, bool one_sided = true);

 private:
  struct Made {
    std::vector<LinearInput> inputs;
    Linearizer linearizer;
  };
  std::optional<Made>& made(const TrimSetting& setting, bool one_sided);

  const System* system_;
  std::vector<std::string> parameters_;
  RecordedSignals signals_;
  std::shared_ptr<Refinement> refinement_;
  std::optional<Made> made_[2];
};

/// Values of the unknowns, with the residuals there.
struct TrimPoint {
  Eigen::VectorXd values;
  Eigen::VectorXd residual;  ///< found - wanted
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd rounding;  ///< of the residuals, by that of all states and inputs
  Linearization matrices;
};

/// r(v) = 0 for the unknowns v at `places`: rates and outputs are as the targets say.
struct TrimProblem {
  TrimReader reader;
  TrimSetting setting;
  std::vector<AnalysisPlace> places;
  std::vector<TrimTarget> targets;
  int evaluations = 0;
  std::string failed = {};  ///< the message of the last failure

  /// Throws ModelError or SimulationError where the system has no finite rates.
  TrimPoint at(const Eigen::VectorXd& values);
  /// The same; empty where it fails.
  std::optional<TrimPoint> tried(const Eigen::VectorXd& values);
};

}  // namespace saltus
