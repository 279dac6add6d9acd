// Crossings at a stop of the solver.
#include "saltus/simulation/detail/stop_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/pass_decisions.hpp"

namespace saltus {

bool StopCrossings::meets(double t, double longest) {
  GuardSet& guards = parts_->guards;
  if (guards.beside_stop.empty()) return !guards.fired_at_root.empty();
  parts_->present.open(t, longest);
  parts_->flow.open(t, longest);
  for (const std::size_t k : guards.beside_stop)
    if (crosses(k)) fire(k);
  guards.beside_stop.clear();
  parts_->flow.forget();
  return !guards.fired_at_root.empty();
}

bool StopCrossings::roots_are_at(double t, double root, double longest) {
  if (t - root <= Calendar::resolution(t)) return true;
  parts_->present.open(root, longest);
  Flow& flow = parts_->flow;
  flow.open(root, longest);
  const GuardSet& guards = parts_->guards;
  const bool there = std::ranges::all_of(guards.fired_at_root, [&](const Firing& firing) {
    const std::size_t k = firing.guard();
    return !parts_->machine.plan().guard(guards[k].group).is_opaque() &&
           std::abs(flow.value_after(t - root, static_cast<Index>(k))) <=
               parts_->crossings.uncertainty(k);
  });
  flow.forget();
  return there;
}

bool StopCrossings::finds_roots() {
  GuardSet& guards = parts_->guards;
  guards.fired_at_root = std::exchange(parts_->present.firings, {});  // of contacts, see load
  for (const std::size_t k : guards.active().all) {
    const Guard& guard = guards[k];
    if (guard.monitor || guard.phase != Phase::armed || !guard.crossed(guards.g[k])) continue;
    guards.fired_at_root.push_back({static_cast<int>(k), guard.side, false});
  }
  return !guards.fired_at_root.empty();
}

bool StopCrossings::crosses(std::size_t k) {
  const GuardSet& guards = parts_->guards;
  const Guard& guard = guards[k];
  if (!guard.active || guard.phase != Phase::armed) return false;
  const auto slot = static_cast<Index>(k);
  const auto fired = [k](const Firing& firing) { return firing.guard() == k; };
  if (std::ranges::any_of(guards.fired_at_root, fired)) return false;
  Flow& flow = parts_->flow;
  const GuardGroup& group = parts_->machine.plan().guard(guard.group);
  const double later = flow.value_after(Calendar::resolution(parts_->present.t), slot);
  const double uncertainty = group.is_opaque() ? 0.0 : parts_->crossings.uncertainty(k);
  const auto flow_to = [&] { return flow.side(group, slot, uncertainty, 0).side; };
  return crosses_at_stop(guard, guards.g[k], later, uncertainty, flow_to);
}

/// A monitor is logged, and is at zero on its other side within its error; any other guard fires.
void StopCrossings::fire(std::size_t k) {
  GuardSet& guards = parts_->guards;
  const Firing firing{static_cast<int>(k), guards[k].side};
  guards.keep();
  if (!guards[k].monitor) return guards.fired_at_root.push_back(firing);
  monitors_->log({parts_->present.t, firing}, parts_->machine.x.data());
  if (guards[k].direction == Direction::edge_detection) return;
  guards.wait(k, -firing.from, location_error(guards.g[k], false));
}

}  // namespace saltus
