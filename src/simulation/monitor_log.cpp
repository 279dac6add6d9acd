// The crossings of monitors: judged at an instant, or logged at once.
#include "saltus/simulation/detail/monitor_log.hpp"

#include <algorithm>

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

bool MonitorLog::judges(const MonitorHit& hit, double t, const std::vector<Firing>& roots) const {
  const auto is_relation = [this](const Firing& firing) {
    return !parts_->machine.plan().guard(parts_->guards[firing.guard()].group).is_crossing();
  };
  return hit.t == t && hit.firing.jump > 0.0 && std::ranges::any_of(roots, is_relation);
}

bool MonitorLog::judges_any() const {
  return std::ranges::any_of(parts_->guards.monitors,
                             [this](const MonitorHit& hit) { return judges(hit); });
}

void MonitorLog::judge(bool flipped) {
  const std::vector<double>& g = parts_->present.g;
  for (const MonitorHit& hit : parts_->guards.monitors) {
    if (!judges(hit)) continue;
    const std::size_t k = hit.firing.guard();
    if (flipped && came_back(hit.firing.from, g[k]))
      parts_->guards.see(k, g[k]);
    else
      log(hit, parts_->machine.x.data());
  }
}

void MonitorLog::log(const MonitorHit& hit, const double* x) {
  parts_->journal.note_monitor(hit, parts_->guards[hit.firing.guard()], parts_->jump, x);
  if (Tangents* tangents = parts_->transition.tangents()) tangents->monitor(hit, x);
}

}  // namespace saltus
