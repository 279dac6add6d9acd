// Dense output: the continuous state and the recorded signals of a run at any time within it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/simulation/detail/trajectory.hpp"

namespace saltus {

/// Reads a trajectory. Signals are computed at (t, x(t)) through the plan, as for a recorded row.
/// The trajectory and the system have to outlive it; one reader serves one thread.
class DenseOutput {
 public:
  explicit DenseOutput(const Trajectory& trajectory);
  ~DenseOutput();
  DenseOutput(const DenseOutput&) = delete;
  DenseOutput& operator=(const DenseOutput&) = delete;

  /// Throws ModelError for a time outside the run, and what a function of the model throws.
  void move_to(double t, Side side = Side::right);
  /// The continuous state of all blocks there.
  VectorView state() const;
  /// Recorded signal number i there.
  VectorView signal(std::size_t i) const;
  const std::vector<Tap>& taps() const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

/// A moment of a run.
struct Moment {
  double time = 0.0;  ///< [s]
  Eigen::VectorXd continuous_state;
  std::vector<std::pair<std::string, Eigen::VectorXd>> outputs;  ///< the recorded signals, by name

  /// A recorded signal by name; a ModelError lists the names there are.
  const Eigen::VectorXd& output(std::string_view name) const;
};

}  // namespace saltus
