// Zeno monitor: when a series of resets becomes a hold, and where it comes to rest.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace saltus {

/// Watches the firings of one guard, or of one edge. Firings whose gaps shrink accumulate at the
/// time that the sum of the geometric series predicts, t_k + gap q / (1 - q), with q the ratio of
/// the last gaps; the states after the resets accumulate likewise.
class ZenoMonitor {
 public:
  explicit ZenoMonitor(double tolerance = 0.0) : tolerance_(tolerance) {}

  bool on() const noexcept { return tolerance_ > 0.0; }
  double tolerance() const noexcept { return tolerance_; }
  double gap() const noexcept {
    return gap_[0];
  }  ///< [s] between the last two firings; infinite before there were two
  bool holding = false;

  /// Forgets all firings: after a release, a gap to the time before says nothing.
  void forget() {
    last_ = nan;
    gap_[0] = gap_[1] = gap_[2] = infinite;
    holding = false;
  }

  /// A firing at t.
  void fired(double t) {
    gap_[2] = gap_[1], gap_[1] = gap_[0];
    gap_[0] = std::isnan(last_) ? infinite : t - last_;
    last_ = t;
  }

  /// Whether the firings accumulate: within the tolerance, and three gaps in a row shrinking by
  /// more than the rounding of the event times explains. A steady fast rhythm does not.
  bool accumulates() const {
    if (!(gap_[0] <= tolerance_) || !std::isfinite(gap_[2])) return false;
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(last_);
    return gap_[1] - gap_[0] > rounding && gap_[2] - gap_[1] > rounding;
  }

  /// q / (1 - q), by which the last gap, and the last change of state, is multiplied.
  double remainder() const {
    // A slow series amplifies the rounding of event times by 1 / (1 - q)^2: there the ratio of two
    // gaps further apart.
    const double last = gap_[0] / gap_[1], q = last > 0.9 ? std::sqrt(gap_[0] / gap_[2]) : last;
    return q / (1.0 - q);
  }
  double accumulation_time() const { return last_ + gap_[0] * remainder(); }

  /// The state after this reset, in; the accumulation state, out.
  void accumulate(Eigen::Ref<Eigen::VectorXd> after) const {
    after += remainder() * (after - after_);
  }
  void remember(const Eigen::Ref<const Eigen::VectorXd>& after) { after_ = after; }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  double tolerance_;
  double last_ = nan;
  double gap_[3] = {infinite, infinite, infinite};
  Eigen::VectorXd after_;
};

}  // namespace saltus
