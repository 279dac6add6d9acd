// Dense output: a machine set to any time of a finished run.
#include "saltus/simulation/dense_output.hpp"

#include "saltus/simulation/detail/contact.hpp"

namespace saltus {

namespace {

const Trajectory& required(const Trajectory& trajectory) {
  if (trajectory.empty())
    throw ModelError("this run kept no dense output; ask for it with the option dense_output");
  return trajectory;
}

}  // namespace

/// It is never moved, because its parts point to each other.
struct DenseOutput::Reader {
  explicit Reader(const Trajectory& of)
      : trajectory(of), machine(of.plan()), contacts(machine, of.tolerances()), x(of.plan()->nx) {
    machine.load(of.start());
  }

  /// Restores the values that were held at that time.
  void hold(const Trajectory::Held& held) {
    now = &held;
    machine.z = held.z, machine.modes = held.modes;
    Index from = 0;
    for (const int i : trajectory.held_nodes()) {
      const Place& place = machine.plan().node(i).place;
      machine.y.segment(place.offset, place.size) = held.y.segment(from, place.size);
      from += place.size;
    }
    contacts.clear();
    for (const SurfaceContact& contact : held.contacts) contacts.add(contact);
    machine.carry_by(contacts.moving() ? &contacts : nullptr);
  }

  const Trajectory& trajectory;
  Machine machine;
  Contacts contacts;
  const Trajectory::Held* now = nullptr;
  Eigen::VectorXd x;
  Values values;
};

DenseOutput::DenseOutput(const Trajectory& trajectory)
    : reader_(std::make_unique<Reader>(required(trajectory))) {}
DenseOutput::~DenseOutput() = default;

void DenseOutput::move_to(double t, Side side) {
  Reader& r = *reader_;
  const Trajectory::Spot spot = r.trajectory.spot(t, side);
  if (const Trajectory::Held& held = r.trajectory.held(spot); &held != r.now) r.hold(held);
  r.trajectory.state(spot, t, r.x.data());
  r.values = r.machine.evaluate_taps(t, r.x.data());
}

VectorView DenseOutput::state() const {
  return {reader_->values.state(), reader_->machine.plan().nx};
}

VectorView DenseOutput::signal(std::size_t i) const {
  const Plan& plan = reader_->machine.plan();
  const Place& place = plan.node(plan.taps[i].node).place;
  return {reader_->values(place), place.size};
}

const std::vector<Tap>& DenseOutput::taps() const { return reader_->machine.plan().taps; }

const Eigen::VectorXd& Moment::output(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& [each, value] : outputs) {
    if (each == name) return value;
    known.push_back(each);
  }
  throw ModelError(text("nothing was recorded under '", name, "'", known_names(name, known)));
}

}  // namespace saltus
