// Dense output: a machine put to any time of a run that is over.
#include "saltus/simulation/dense_output.hpp"

#include "saltus/simulation/results.hpp"

namespace saltus {

namespace {

const Trajectory& required(const Trajectory& trajectory) {
  if (trajectory.empty())
    throw ModelError("this run kept no dense output; ask for it with the option dense_output");
  return trajectory;
}

}  // namespace

DenseOutput::DenseOutput(const Trajectory& trajectory)
    : trajectory_(&required(trajectory)),
      machine_(trajectory.plan()),
      contacts_(machine_, trajectory.tolerances()),
      x_(trajectory.plan()->nx) {
  machine_.load(trajectory.start());
}

/// Puts back what stood still at that time.
void DenseOutput::hold(const Trajectory::Held& held) {
  now_ = &held;
  machine_.z = held.z, machine_.modes = held.modes;
  Index from = 0;
  for (const int i : trajectory_->held_nodes()) {
    const Place& place = machine_.plan().node(i).place;
    machine_.y.segment(place.offset, place.size) = held.y.segment(from, place.size);
    from += place.size;
  }
  contacts_.clear();
  for (const SurfaceContact& contact : held.contacts) contacts_.add(contact);
  machine_.carry_by(contacts_.moving() ? &contacts_ : nullptr);
}

void DenseOutput::move_to(double t, Side side) {
  const Trajectory::Spot spot = trajectory_->spot(t, side);
  if (const Trajectory::Held& held = trajectory_->held(spot); &held != now_) hold(held);
  trajectory_->state(spot, t, x_.data());
  values_ = machine_.evaluate_taps(t, x_.data());
}

const Eigen::VectorXd& Moment::output(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& [each, value] : outputs) {
    if (each == name) return value;
    known.push_back(each);
  }
  throw ModelError(text("nothing was recorded under '", name, "'", known_names(name, known)));
}

Moment Results::at(double t, Side side) const {
  DenseOutput dense(trajectory);
  dense.move_to(t, side);
  Moment moment{t, dense.state(), {}};
  for (std::size_t i = 0; i < dense.taps().size(); ++i)
    moment.outputs.emplace_back(dense.taps()[i].name, dense.signal(i));
  return moment;
}

}  // namespace saltus
