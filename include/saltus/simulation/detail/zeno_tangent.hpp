// ZenoTangent: the derivative of a ZenoMonitor.
#pragma once

#include <array>

#include <Eigen/Core>

#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// The last firings of one guard with the derivatives of their times, and the states after them. It
/// differentiates the sums of ZenoMonitor: the accumulation time and the accumulation state.
class ZenoTangent {
 public:
  /// A firing at t, whose time has these derivatives.
  void fired(double t, const Eigen::RowVectorXd& dt);
  void remember(Eigen::VectorXd after, Eigen::MatrixXd derivatives) {
    after_ = std::move(after), after_tangent_ = std::move(derivatives);
  }
  /// Whether all firings that the sums use were in this run: a run that begins between the last ones
  /// has the times of the earlier ones from its context, without their derivatives.
  bool knows() const;
  /// The derivative of the accumulation time.
  Eigen::RowVectorXd accumulation_time() const;
  /// The derivatives of the accumulation state, from the states after this firing.
  Eigen::MatrixXd accumulate(const Eigen::VectorXd& after,
                             const Eigen::MatrixXd& derivatives) const;

 private:
  struct Remainder {
    double value;
    Eigen::RowVectorXd derivative;
  };
  double gap(std::size_t i) const { return times_[i] - times_[i + 1]; }
  Eigen::RowVectorXd gap_tangent(std::size_t i) const { return tangents_[i] - tangents_[i + 1]; }
  Remainder remainder() const;

  std::array<double, 4> times_{};  // [s] latest first
  std::array<Eigen::RowVectorXd, 4> tangents_;
  int count_ = 0;  // of firings
  Eigen::VectorXd after_;
  Eigen::MatrixXd after_tangent_;
};

}  // namespace saltus
