// Dense output: the readers of all islands as one.
#include "saltus/simulation/dense_output.hpp"

#include "saltus/simulation/detail/recorded_under.hpp"
#include "saltus/simulation/detail/trajectory_reader.hpp"

namespace saltus {

namespace {

const Trajectory& required(const Trajectory& trajectory) {
  require_kept(trajectory);
  return trajectory;
}

}  // namespace

/// One reader of pieces for each island, or the only one.
struct DenseOutput::Reader {
  explicit Reader(const Trajectory& all) : whole(all) {
    if (whole.parts().empty()) {
      readers.push_back(std::make_unique<TrajectoryReader>(whole));
      return;
    }
    x.setZero(whole.plan()->nx), places.resize(whole.plan()->taps.size());
    for (const Trajectory::Part& part : whole.parts()) {
      for (std::size_t i = 0; i < part.signals.size(); ++i)
        places[static_cast<std::size_t>(part.signals[i])] = {readers.size(), i};
      readers.push_back(std::make_unique<TrajectoryReader>(*part.of));
    }
  }

  bool has_parts() const { return !whole.parts().empty(); }
  void move_to(double t, Side side) {
    require_inside(whole, t);
    for (std::size_t k = 0; k < readers.size(); ++k) {
      readers[k]->move_to(t, side);
      if (!has_parts()) continue;
      for (const auto& [from, to, size] : whole.parts()[k].states)
        x.segment(to, size) = readers[k]->state().segment(from, size);
    }
  }

  const Trajectory& whole;
  std::vector<std::unique_ptr<TrajectoryReader>> readers;
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
  return detail::recorded_under(outputs, name, &decltype(outputs)::value_type::first).second;
}

}  // namespace saltus
