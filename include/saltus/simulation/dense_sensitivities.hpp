// Dense sensitivities: the derivatives of a run at any time within it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/trajectory.hpp"
#include "saltus/simulation/sensitivities.hpp"

namespace saltus {

/// Reads the derivatives of the values of DenseOutput, at a fixed time. Those of states are the
/// polynomials by which the linear equation S' = f_x S + f_p was solved. Those of signals follow from
/// them at (t, x(t)) as in a recorded row. The results and the system have to outlive it; one reader
/// serves one thread.
class DenseSensitivities {
 public:
  /// Throws ModelError for a run without the options `sensitivity` and `dense_output`.
  DenseSensitivities(const Trajectory& trajectory, const Sensitivities& sensitivities);
  ~DenseSensitivities();
  DenseSensitivities(const DenseSensitivities&) = delete;
  DenseSensitivities& operator=(const DenseSensitivities&) = delete;

  /// Throws ModelError for a time outside the run, and what a function of the model throws.
  void move_to(double t, Side side = Side::right);
  /// The derivatives of the continuous state of all blocks there: states x parameters.
  const Eigen::MatrixXd& state() const;
  /// Those of recorded signal number i there: entries x parameters.
  const Eigen::MatrixXd& signal(std::size_t i) const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

/// The derivatives at a moment of a run; NaN where there are none. Each matrix has a column for each
/// parameter.
struct MomentSensitivities {
  double time = 0.0;                    ///< [s]
  std::vector<std::string> parameters;  ///< the names of the columns
  Eigen::MatrixXd continuous_state;
  std::vector<std::pair<std::string, Eigen::MatrixXd>> outputs;  ///< the recorded signals, by name

  /// Those of a recorded signal by name; a ModelError lists the names there are.
  const Eigen::MatrixXd& output(std::string_view name) const;
};

}  // namespace saltus
