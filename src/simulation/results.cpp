// Results: a recorded signal by name, and the run at any time.
#include "saltus/simulation/results.hpp"
#include "saltus/simulation/detail/recorded_under.hpp"

namespace saltus {

const RecordedSignal& Results::signal(std::string_view name) const {
  return detail::recorded_under(signals, name, &RecordedSignal::name);
}

Eigen::Map<const RecordedSignal::Matrix> Results::output(std::string_view name) const {
  return signal(name).matrix();
}

const std::vector<double>& Results::time_of(std::string_view name) const {
  return time_of(signal(name));
}

const std::vector<double>& Results::time_of(const RecordedSignal& signal) const {
  return signal.island < 0 ? time : nth(islands, signal.island).time;
}

const std::vector<int>& Results::jump_of(std::string_view name) const {
  const int island = signal(name).island;
  return island < 0 ? jump : nth(islands, island).jump;
}

Moment Results::at(double t, Side side) const {
  DenseOutput dense(trajectory);
  dense.move_to(t, side);
  Moment moment{t, dense.state(), {}};
  for (std::size_t i = 0; i < dense.taps().size(); ++i)
    moment.outputs.emplace_back(dense.taps()[i].name, dense.signal(i));
  return moment;
}

MomentSensitivities Results::sensitivities_at(double t, Side side) const {
  DenseSensitivities dense(trajectory, sensitivities);
  dense.move_to(t, side);
  MomentSensitivities moment{t, sensitivities.parameters, dense.state(), {}};
  const std::vector<Tap>& taps = trajectory.plan()->taps;
  for (std::size_t i = 0; i < taps.size(); ++i)
    moment.outputs.emplace_back(taps[i].name, dense.signal(i));
  return moment;
}

}  // namespace saltus
