// period_map: the linear map of a sampled system over one period.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "saltus/analysis/trim.hpp"
#include "saltus/simulation/simulate.hpp"

namespace saltus {

struct PeriodMapOptions {
  /// Dynamic parameters, by the names of `sensitivity`. An open input needs a block, such as
  /// Constant, whose parameter is named here.
  std::vector<std::string> inputs = {};
  /// The outputs at the start of a period. Empty: all states.
  std::optional<RecordedSignals> outputs = {};
  /// The options of each run. Change single ones, so that the tight tolerances stay.
  SimulatorOptions simulation = {.rtol = 1e-10, .atol = 1e-12};
};

/// x[k+1] = x1 + Phi (x[k] - x0) + Gamma (u[k] - u0), y[k] = y + C (x[k] - x0) + D (u[k] - u0).
struct PeriodMap {
  Eigen::MatrixXd Phi;              ///< dx[k+1]/dx[k]: (state, state)
  Eigen::MatrixXd Gamma;            ///< dx[k+1]/du: (state, input)
  Eigen::MatrixXd C, D;             ///< dy/dx: (output, state), dy/du: (output, input)
  std::vector<std::string> states;  ///< continuous states, then discrete ones that are numbers
  std::vector<std::string> inputs, outputs;
  Eigen::VectorXd x0;  ///< at the start, after the instant there
  Eigen::VectorXd x1;  ///< after one period
  Eigen::VectorXd y;   ///< the outputs at the start
  /// The discrete states that are labels, whole numbers on which nothing depends smoothly.
  std::vector<NamedValue> frozen;
  double period = 0.0;   ///< [s]
  Context context;       ///< the values at the start
  Eigen::VectorXd size;  ///< of each state in the period

  /// Whether the start returns to itself.
  bool is_fixed_point() const;
  /// The eigenvalues of Phi, the largest first.
  Eigen::VectorXcd multipliers() const;
  /// Stable: all multipliers are inside the unit circle; undecided if the largest is so close to the
  /// circle that its error decides.
  Stability stability() const;
};

/// Writes the period, the names and the multipliers. Needs `<ostream>`.
std::ostream& operator<<(std::ostream& out, const PeriodMap& map);

/// The map x[k+1] = x1 + Phi (x[k] - x0) + Gamma (u[k] - u0) over one period [s], through all events:
/// the sample time, or a multiple that all clocks have in common. x are the continuous and the
/// discrete states just after the instant at the start of a period, and u are parameters that stay
/// constant during it. Phi and Gamma are the derivatives of a run (docs/derivatives.md) of one
/// period, from x0 to x1. At a fixed point x1 = x0; elsewhere they are those of a moving state.
///
/// Throws ModelError for a period that is not positive or not one of the clocks, an unknown name, and
/// a mode that has another value after the period. SimulationError if a derivative does not exist, with
/// the event and the time; from a run that ends badly as from `simulate`.
PeriodMap period_map(const System& system, const Context& context, double period,
                     const PeriodMapOptions& options = {});

}  // namespace saltus
