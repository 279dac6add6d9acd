// Dense sensitivities: a probe beside the reader of each island.
#include "saltus/simulation/dense_sensitivities.hpp"

#include "saltus/simulation/detail/recorded_under.hpp"
#include "saltus/simulation/detail/signal_tangents.hpp"
#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/detail/trajectory_reader.hpp"

namespace saltus {

/// The derivatives of one trajectory without parts.
class TangentReader {
 public:
  TangentReader(const Trajectory& trajectory, const TangentTrajectory& tangents)
      : reader_(trajectory), tangents_(tangents), probe_(reader_.machine()) {}

  void move_to(double t, Side side) {
    reader_.move_to(t, side);
    TangentTrajectory::Moment now = tangents_.at(t, side);
    RestingStates& resting = reader_.machine().resting();
    resting.clear();
    for (Index i = 0; i < std::ssize(*now.rests); ++i)
      if ((*now.rests)[i]) resting.rest(i);
    probe_.take(*now.sizes);
    const double* x = reader_.x().data();
    fix_time(probe_, t, x, now.columns);
    const Plan& plan = reader_.machine().plan();
    signals_ = signal_tangents(probe_, plan, t, x, now.columns);
    put_views(plan, now.columns.x, now.columns.z, signals_);
    state_ = std::move(now.columns.x);
  }
  const Eigen::MatrixXd& state() const { return state_; }
  /// A row for each entry of each tap.
  const Eigen::MatrixXd& signals() const { return signals_; }

 private:
  TrajectoryReader reader_;
  const TangentTrajectory& tangents_;
  TangentProbe probe_;
  Eigen::MatrixXd state_, signals_;
};

/// Copies what each island has to its rows and columns among those of all.
struct DenseSensitivities::Reader {
  struct Island {
    TangentReader reader;
    std::vector<Trajectory::Part::States> states;
    std::vector<int> signals;    // the number in all of each of its recorded signals
    std::vector<Index> columns;  // likewise
  };

  Reader(const Trajectory& all, const Sensitivities& sensitivities) : whole(all) {
    const auto m = static_cast<Index>(sensitivities.size());
    const Plan& plan = *all.plan();
    state.setZero(plan.nx, m);
    for (const Tap& tap : plan.taps)
      signals.emplace_back(Eigen::MatrixXd::Zero(plan.node(tap.node).place.size, m));
    const TangentTrajectory& tangents = sensitivities.trajectory;
    if (all.parts().empty()) add_all(tangents, m);
    for (std::size_t k = 0; k < all.parts().size(); ++k) {
      const Trajectory::Part& part = all.parts()[k];
      const TangentTrajectory::Part& own = tangents.parts()[k];
      if (own.of == nullptr) continue;
      islands.emplace_back(new Island{{*part.of, *own.of}, part.states, part.signals, own.columns});
    }
  }

  void add_all(const TangentTrajectory& tangents, Index m) {
    std::vector<int> every(signals.size());
    for (std::size_t i = 0; i < every.size(); ++i) every[i] = static_cast<int>(i);
    std::vector<Index> columns(static_cast<std::size_t>(m));
    for (Index k = 0; k < m; ++k) nth(columns, k) = k;
    islands.emplace_back(
        new Island{{whole, tangents}, {{0, 0, state.rows()}}, std::move(every), columns});
  }

  void move_to(double t, Side side) {
    require_inside(whole, t);
    for (const auto& island : islands) {
      island->reader.move_to(t, side);
      copy(*island);
    }
  }

  void copy(const Island& island) {
    for (Index k = 0; k < std::ssize(island.columns); ++k) {
      const Index column = nth(island.columns, k);
      for (const auto& [from, to, size] : island.states)
        state.col(column).segment(to, size) = island.reader.state().col(k).segment(from, size);
      Index first = 0;
      for (const int number : island.signals) {
        Eigen::MatrixXd& signal = nth(signals, number);
        signal.col(column) = island.reader.signals().col(k).segment(first, signal.rows());
        first += signal.rows();
      }
    }
  }

  const Trajectory& whole;
  std::vector<std::unique_ptr<Island>> islands;  // those with columns of their own
  Eigen::MatrixXd state;
  std::vector<Eigen::MatrixXd> signals;
};

namespace {

const Trajectory& kept(const Trajectory& trajectory, const Sensitivities& sensitivities) {
  require_kept(trajectory);
  if (sensitivities.trajectory.empty())
    throw ModelError("this run has no derivatives; ask for them with the option sensitivity");
  return trajectory;
}

}  // namespace

DenseSensitivities::DenseSensitivities(const Trajectory& trajectory,
                                       const Sensitivities& sensitivities)
    : reader_(std::make_unique<Reader>(kept(trajectory, sensitivities), sensitivities)) {}
DenseSensitivities::~DenseSensitivities() = default;

void DenseSensitivities::move_to(double t, Side side) { reader_->move_to(t, side); }
const Eigen::MatrixXd& DenseSensitivities::state() const { return reader_->state; }
const Eigen::MatrixXd& DenseSensitivities::signal(std::size_t i) const {
  return reader_->signals[i];
}

const Eigen::MatrixXd& MomentSensitivities::output(std::string_view name) const {
  return detail::recorded_under(outputs, name, &decltype(outputs)::value_type::first).second;
}

}  // namespace saltus
