// Zeno monitor: when a series of resets becomes a hold, and where it comes to rest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "saltus/model/continuation.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// Watches the firings of one guard, or of one edge. Firings whose gaps shrink accumulate at the
/// time that the sum of the geometric series predicts, t_k + gap q / (1 - q), with q the ratio of
/// the last gaps; the states after the resets accumulate likewise.
class ZenoMonitor {
 public:
  /// `rtol` is the relative tolerance of the method, which bounds the error of a gap; `share` is the
  /// share of the longest gap that the last one may have at most.
  explicit ZenoMonitor(double tolerance = 0.0, double rtol = 0.0, double share = 1.0)
      : tolerance_(tolerance), rtol_(rtol), share_(share) {}

  bool on() const noexcept { return tolerance_ > 0.0; }
  double tolerance() const noexcept { return tolerance_; }
  /// [s] between the last two firings; infinite before the second one.
  double gap() const noexcept { return gap(0); }
  bool holding = false;

  /// Forgets all firings. After a release, a gap to an earlier firing has no meaning.
  void forget() {
    times_.fill(nan);
    longest_ = 0.0;
    holding = false;
  }

  /// Notes a firing at t.
  void fired(double t) {
    std::copy_backward(times_.begin(), times_.end() - 1, times_.end());
    times_[0] = t;
    if (std::isfinite(gap(0))) longest_ = std::max(longest_, gap(0));
  }

  /// Whether the firings accumulate: the last gap is short, and three gaps in a row
  /// shrink by more than the rounding of the event times and the tolerance of the method. A steady
  /// fast rhythm does not accumulate: a multistep method loses a part of its speed at each impact,
  /// and its gaps shrink by a part of the tolerance. Nor do some short gaps after a long one: the
  /// ratio of the gaps is that of a series. Nor do gaps that approach a length above zero: their ratio
  /// approaches 1, and the sum that it predicts grows faster than the firings come.
  bool accumulates() const {
    if (!is_short() || !std::isfinite(gap(2))) return false;
    const double error =
        thresholds::gap_roundings * thresholds::eps * std::abs(times_[0]) + rtol_ * gap(0);
    if (!(gap(1) - gap(0) > error && gap(2) - gap(1) > error)) return false;
    const double last = gap(0) / gap(1), before = gap(1) / gap(2);
    return last <= thresholds::same_ratio * before && before <= thresholds::same_ratio * last &&
           is_supported(last, before, error);
  }

  /// Whether the last gap is within the tolerance, and within its share of the longest one.
  bool is_short() const { return gap(0) <= tolerance_ && gap(0) <= share_ * longest_; }

  /// Whether the ratio of the gaps changes so slowly that it says something of all gaps that are left.
  /// The error of the gaps does not count as a change.
  bool is_supported(double last, double before, double error) const {
    const double left = 1.0 - last, change = std::abs(last - before) - 4.0 * error / gap(0);
    return change <= thresholds::supported_change * left * left;
  }

  /// q / (1 - q): the factor of the last gap, and of the last change of state.
  double remainder() const {
    // A slow series amplifies the rounding of event times by 1 / (1 - q)^2: there the ratio comes
    // from two gaps further apart.
    const double last = gap(0) / gap(1),
                 q = last > thresholds::slow_series ? std::sqrt(gap(0) / gap(2)) : last;
    return q / (1.0 - q);
  }
  double accumulation_time() const { return times_[0] + gap(0) * remainder(); }

  /// Turns the state after this reset into the accumulation state.
  void accumulate(Eigen::Ref<Eigen::VectorXd> after) const {
    after += remainder() * (after - after_);
  }
  void remember(const Eigen::Ref<const Eigen::VectorXd>& after) { after_ = after; }

  Continuation::Firings save() const {
    Continuation::Firings saved{.longest = longest_, .holding = holding};
    for (const double t : times_) {
      if (!std::isnan(t)) saved.times.push_back(t);
    }
    saved.after.assign(after_.begin(), after_.end());
    return saved;
  }
  /// Firings without the state after the latest, where there is a state, do not count.
  void load(const Continuation::Firings& saved, std::size_t states) {
    forget();
    holding = saved.holding;
    if (saved.after.size() != states) return;
    std::copy_n(saved.times.begin(), std::min(saved.times.size(), times_.size()), times_.begin());
    longest_ = saved.longest;
    for (std::size_t i = 0; i + 1 < times_.size();
         ++i)  // data of earlier versions have no longest gap
      if (std::isfinite(gap(i))) longest_ = std::max(longest_, gap(i));
    after_ = Eigen::Map<const Eigen::VectorXd>(saved.after.data(),
                                               static_cast<Eigen::Index>(saved.after.size()));
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  /// [s] Gap i, counted back from the last one; infinite if there were too few firings.
  double gap(std::size_t i) const {
    const double gap = times_[i] - times_[i + 1];
    return std::isnan(gap) ? std::numeric_limits<double>::infinity() : gap;
  }

  double tolerance_, rtol_, share_;
  double longest_ = 0.0;                             // [s] gap since the last release
  std::array<double, 4> times_{nan, nan, nan, nan};  // [s] of the last firings, latest first
  Eigen::VectorXd after_;
};

}  // namespace saltus
