// Crossings at a stop of the solver: whether a guard crosses there or a rounding later is decided by the flow,
// not by the rounding of the method.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/instant.hpp"
#include "saltus/simulation/detail/pass_decisions.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

bool Instant::meets_stop(double t, double longest) {
  if (guards_->beside_stop.empty()) return !guards_->fired_at_root.empty();
  present_.open(t, longest);
  flow_.open(t, longest);
  for (const std::size_t k : guards_->beside_stop)
    if (crosses_at_stop(k)) fire_at_stop(k);
  guards_->beside_stop.clear();
  flow_.forget();
  return !guards_->fired_at_root.empty();
}

bool Instant::roots_are_at(double t, double root, double longest) {
  if (t - root <= Calendar::resolution(t)) return true;
  present_.open(root, longest);
  flow_.open(root, longest);
  const bool there = std::ranges::all_of(guards_->fired_at_root, [&](const Firing& firing) {
    const std::size_t k = firing.guard();
    return !plan().guard((*guards_)[k].group).is_opaque() &&
           std::abs(flow_.value_after(t - root, static_cast<Index>(k))) <=
               crossings_.uncertainty(k);
  });
  flow_.forget();
  return there;
}

bool Instant::crosses_at_stop(std::size_t k) {
  const Guard& guard = (*guards_)[k];
  if (!guard.active || guard.phase != Phase::armed) return false;
  const auto slot = static_cast<Index>(k);
  const auto fired = [k](const Firing& firing) { return firing.guard() == k; };
  if (std::ranges::any_of(guards_->fired_at_root, fired)) return false;
  const GuardGroup& group = plan().guard(guard.group);
  const double g = guards_->g[k];
  const double later = flow_.value_after(Calendar::resolution(present_.t), slot);
  const double uncertainty = group.is_opaque() ? 0.0 : crossings_.uncertainty(k);
  const auto flow_to = [&] { return flow_.side(group, slot, uncertainty, 0).side; };
  return saltus::crosses_at_stop(guard, g, later, uncertainty, flow_to);
}

/// A monitor is logged, and is at zero on its other side within its error; any other guard fires.
void Instant::fire_at_stop(std::size_t k) {
  const Firing firing{static_cast<int>(k), (*guards_)[k].side};
  guards_->keep();
  if (!(*guards_)[k].monitor) return guards_->fired_at_root.push_back(firing);
  const MonitorHit hit{present_.t, firing};
  log_monitor(hit, machine_->x.data());
  if (Tangents* tangents = transition_.tangents()) tangents->monitor(hit, machine_->x.data());
  if ((*guards_)[k].direction == Direction::edge_detection) return;
  guards_->wait(k, -firing.from, location_error(guards_->g[k], false));
}

}  // namespace saltus
