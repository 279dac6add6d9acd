// MonitorLog: the crossings of monitors, in the log.
#pragma once

#include <vector>

#include "saltus/simulation/detail/instant_parts.hpp"

namespace saltus {

/// A monitor changes nothing, so its crossings are logged where the solver found them. A monitor that jumped at the
/// root of a relation may come back when the relation flips: the instant judges it then.
class MonitorLog {
 public:
  explicit MonitorLog(InstantParts& parts) : parts_(&parts) {}

  /// Whether the instant at t [s] has to judge this crossing: the monitor jumped at the root there, at which
  /// relations are among the guards that fired, `roots`.
  bool judges(const MonitorHit& hit, double t, const std::vector<Firing>& roots) const;
  /// Whether the present instant has to judge some crossing.
  bool judges_any() const;
  /// Logs these crossings, but not where the monitor came back. `flipped`: a relation has flipped.
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
