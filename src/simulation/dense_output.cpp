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

/// One reader of pieces for each island, or the only one.
struct DenseOutput::Reader {
  /// Reads a trajectory without parts. It is never moved, because its members point to each other.
  struct OfPieces {
    explicit OfPieces(const Trajectory& of)
        : trajectory(of), machine(of.plan()), contacts(machine, of.tolerances()), x(of.plan()->nx) {
      machine.load(of.start());
    }

    void move_to(double t, Side side) {
      const Trajectory::Spot spot = trajectory.spot(t, side);
      if (const Trajectory::Held& held = trajectory.held(spot); &held != now) hold(held);
      trajectory.state(spot, t, x.data());
      values = machine.evaluate_taps(t, x.data());
    }
    VectorView state() const { return {values.state(), machine.plan().nx}; }
    VectorView signal(std::size_t i) const {
      const Plan& plan = machine.plan();
      const Place& place = plan.node(plan.taps[i].node).place;
      return {values(place), place.size};
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

  explicit Reader(const Trajectory& all) : whole(all) {
    if (whole.parts().empty()) {
      readers.push_back(std::make_unique<OfPieces>(whole));
      return;
    }
    x.setZero(whole.plan()->nx), places.resize(whole.plan()->taps.size());
    for (const Trajectory::Part& part : whole.parts()) {
      for (std::size_t i = 0; i < part.signals.size(); ++i)
        places[static_cast<std::size_t>(part.signals[i])] = {readers.size(), i};
      readers.push_back(std::make_unique<OfPieces>(*part.of));
    }
  }

  bool has_parts() const { return !whole.parts().empty(); }
  void move_to(double t, Side side) {
    whole.require_inside(t);
    for (std::size_t k = 0; k < readers.size(); ++k) {
      readers[k]->move_to(t, side);
      if (!has_parts()) continue;
      for (const auto& [from, to, size] : whole.parts()[k].states)
        x.segment(to, size) = readers[k]->state().segment(from, size);
    }
  }

  const Trajectory& whole;
  std::vector<std::unique_ptr<OfPieces>> readers;
  std::vector<std::pair<std::size_t, std::size_t>> places;  // of each signal: reader and number
  Eigen::VectorXd x;
};

DenseOutput::DenseOutput(const Trajectory& trajectory)
    : reader_(std::make_unique<Reader>(required(trajectory))) {}
DenseOutput::~DenseOutput() = default;

void DenseOutput::move_to(double t, Side side) { reader_->move_to(t, side); }

VectorView DenseOutput::state() const {
  const Reader& r = *reader_;
  return r.has_parts() ? VectorView(r.x.data(), r.x.size()) : r.readers.front()->state();
}

VectorView DenseOutput::signal(std::size_t i) const {
  const Reader& r = *reader_;
  const auto [part, number] = r.has_parts() ? r.places[i] : std::pair{std::size_t{0}, i};
  return r.readers[part]->signal(number);
}

const std::vector<Tap>& DenseOutput::taps() const { return reader_->whole.plan()->taps; }

const Eigen::VectorXd& Moment::output(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& [each, value] : outputs) {
    if (each == name) return value;
    known.push_back(each);
  }
  throw ModelError(text("nothing was recorded under '", name, "'", known_names(name, known)));
}

}  // namespace saltus
