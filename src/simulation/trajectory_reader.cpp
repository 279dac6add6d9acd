#include "saltus/simulation/detail/trajectory_reader.hpp"

namespace saltus {

TrajectoryReader::TrajectoryReader(const Trajectory& of)
    : trajectory_(of),
      machine_(of.plan()),
      contacts_(machine_, of.tolerances()),
      x_(of.plan()->nx) {
  machine_.load(of.start());
}

void TrajectoryReader::move_to(double t, Side side) {
  const Trajectory::Spot spot = trajectory_.spot(t, side);
  if (const Trajectory::Held& held = trajectory_.held(spot); &held != now_) hold(held);
  trajectory_.state(spot, t, x_.data());
  values_ = machine_.evaluate_taps(t, x_.data());
}

VectorView TrajectoryReader::signal(std::size_t i) const {
  const Plan& plan = machine_.plan();
  const Place& place = plan.node(plan.taps[i].node).place;
  return {values_(place), place.size};
}

/// Restores the values that were held at that time.
void TrajectoryReader::hold(const Trajectory::Held& held) {
  now_ = &held;
  machine_.z = held.z, machine_.modes = held.modes;
  Index from = 0;
  for (const int i : trajectory_.held_nodes()) {
    const Place& place = machine_.plan().node(i).place;
    machine_.y.segment(place.offset, place.size) = held.y.segment(from, place.size);
    from += place.size;
  }
  contacts_.clear();
  for (const SurfaceContact& contact : held.contacts) contacts_.add(contact);
  machine_.carry_by(contacts_.moving() ? &contacts_ : nullptr);
}

}  // namespace saltus
