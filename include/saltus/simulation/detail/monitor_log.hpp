// MonitorLog: the crossings of monitors, in the log.
#pragma once

#include <vector>

#include "saltus/simulation/detail/instant_parts.hpp"

namespace saltus {

/// A monitor changes nothing, so its crossings are logged where the solver found them. One that jumped at the
/// root of a relation may come back when that relation flips: it is judged then.
class MonitorLog {
 public:
  explicit MonitorLog(InstantParts& parts) : parts_(&parts) {}

  /// Whether the instant at t [s] has to judge this crossing: the monitor jumped at the root there, at which
  /// relations are among the guards that fired, `roots`.
  bool judges(const MonitorHit& hit, double t, const std::vector<Firing>& roots) const;
  /// Whether the present instant has to judge some crossing.
  bool judges_any() const;
  /// Logs those that did not come back. `flipped`: a relation has.
  void judge(bool flipped);
  /// Logs a crossing, at the state x.
  void log(const MonitorHit& hit, const double* x);

 private:
  bool judges(const MonitorHit& hit) const {
    return judges(hit, parts_->present.t, parts_->roots());
  }

  InstantParts* parts_;
};

}  // namespace saltus
