// OneSided: the entries of the state that have only one-sided derivatives at the time of an instant.
#pragma once

#include <limits>
#include <string>
#include <utility>

#include "saltus/simulation/detail/tangent_flow.hpp"

namespace saltus {

/// A small change of a parameter p moves an instant at tau(p), so that it comes before or after the
/// fixed time tau. An entry of the state has a derivative there only if the instant does not move
/// with p, or if it changes neither the entry nor its derivative.
class OneSided {
 public:
  using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

  void begin() { t_ = std::numeric_limits<double>::quiet_NaN(); }
  /// An instant opens, with these derivatives at a fixed time.
  void open(const Machine& machine, TangentColumns before) {
    x_ = machine.x, z_ = machine.z, before_ = std::move(before);
  }
  const TangentColumns& before() const noexcept { return before_; }
  /// Notes what the instant at t has changed up to now. `moving` are the derivatives at the moving
  /// time, `fixed` those at a fixed time, `event` is the cause of the instant.
  void judge(double t, const Machine& machine, const TangentColumns& moving,
             const TangentColumns& fixed, const std::string& event);

  /// Whether t is the time of an instant that changes something for parameter k.
  bool holds(double t, Index k) const {
    return t == t_ && (of_x_.col(k).any() || of_z_.col(k).any());
  }
  /// A row for each state, a column for each parameter.
  const Mask& of_x() const noexcept { return of_x_; }
  const Mask& of_z() const noexcept { return of_z_; }
  const std::string& event() const noexcept { return event_; }

 private:
  double t_ = std::numeric_limits<double>::quiet_NaN();  // [s] of the last instant
  Eigen::VectorXd x_, z_;
  TangentColumns before_;
  Mask of_x_, of_z_;
  std::string event_;
};

}  // namespace saltus
