// Results: a recorded signal by name, and the run at any time.
#include "saltus/simulation/results.hpp"

namespace saltus {

Eigen::Map<const RecordedSignal::Matrix> Results::output(std::string_view name) const {
  std::vector<std::string> known;
  for (const RecordedSignal& signal : signals) {
    if (signal.name == name) return signal.matrix();
    known.push_back(signal.name);
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
