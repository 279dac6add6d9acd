// TangentStart: the derivatives with which a run begins.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/context.hpp"
#include "saltus/simulation/detail/computed_derivatives.hpp"
#include "saltus/simulation/detail/tangent_columns.hpp"
#include "saltus/simulation/detail/variation.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

struct SensitivityEntry;

/// Reads the option `sensitivity`: a parameter or a start value is a column, a vector one for each
/// entry.
class TangentStart {
 public:
  /// Throws ModelError for a plan with a part that has no derivatives here.
  TangentStart(const Plan& plan, const SimulatorOptions& options);

  /// Throws ModelError for a name that is unknown, or that has no derivative.
  void require_fits(const Context& start) const;

  struct Begun {
    std::vector<std::string> names = {};  ///< of the columns
    std::vector<std::string> obstacles =
        {};  ///< why a column has no derivative; empty if it has one
    Variation::Tolerances tolerances;
    Eigen::VectorXd state_atol;  ///< the tolerances of the states themselves
  };
  /// Writes the columns of a run that begins at these values. Those of the signals are zero.
  Begun begin(const Context& start, TangentColumns& columns);

  /// The number of names of the option.
  std::size_t names() const noexcept { return options_->sensitivity.size(); }

 private:
  std::vector<ParameterDirection> directions_of(const std::vector<SensitivityEntry>& all,
                                                const Context& start);
  Eigen::VectorXd state_atol() const;
  Eigen::MatrixXd atol_of(const std::vector<SensitivityEntry>& all, const Context& start) const;

  const Plan* plan_;
  const SimulatorOptions* options_;
  ComputedDerivatives computed_;
};

}  // namespace saltus
