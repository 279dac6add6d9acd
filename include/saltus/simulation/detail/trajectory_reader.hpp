// TrajectoryReader: a machine set to any time of a finished run.
#pragma once

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/simulation/detail/trajectory.hpp"

namespace saltus {

/// Reads a trajectory without parts. It is never moved, because its members point to each other.
class TrajectoryReader {
 public:
  explicit TrajectoryReader(const Trajectory& of);
  TrajectoryReader(const TrajectoryReader&) = delete;
  TrajectoryReader& operator=(const TrajectoryReader&) = delete;

  /// Sets the machine to the state and to the held values of a time within the run.
  void move_to(double t, Side side);
  /// The state, also of blocks that a surface carries, and signal i of the taps there.
  VectorView state() const { return {values_.state(), machine_.plan().nx}; }
  VectorView signal(std::size_t i) const;

  Machine& machine() noexcept { return machine_; }
  /// The state of the polynomials.
  const Eigen::VectorXd& x() const noexcept { return x_; }

 private:
  void hold(const Trajectory::Held& held);

  const Trajectory& trajectory_;
  Machine machine_;
  Contacts contacts_;
  const Trajectory::Held* now_ = nullptr;
  Eigen::VectorXd x_;
  Values values_;
};

}  // namespace saltus
