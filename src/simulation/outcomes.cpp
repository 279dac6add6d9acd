// Outcomes: columns that the threads of an ensemble fill. Each run writes its own row.
#include "saltus/simulation/outcomes.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace saltus {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void put(std::vector<double>& column, std::size_t run, const Eigen::VectorXd& values) {
  const auto width = static_cast<std::size_t>(values.size());
  std::copy_n(values.data(), width, column.begin() + static_cast<std::ptrdiff_t>(run * width));
}

/// The last row at exactly t, which is the row after the events at t, if any.
std::optional<std::size_t> row_at(const std::vector<double>& rows, double t) {
  const auto after = std::ranges::upper_bound(rows, t);
  if (after == rows.begin() || *(after - 1) != t) return {};
  return static_cast<std::size_t>(after - rows.begin()) - 1;
}

}  // namespace

Outcomes::Outcomes(const Ensemble& ensemble, std::vector<double> at) : times(std::move(at)) {
  const auto runs = static_cast<std::size_t>(ensemble.size());
  const Plan& plan = ensemble.plan();
  status.assign(runs, not_run), message.resize(runs), block.resize(runs);
  end_time.assign(runs, nothing), wall_time.assign(runs, nothing);
  events.assign(runs, 0), steps.assign(runs, 0);
  continuous_state.assign(runs * static_cast<std::size_t>(plan.nx), nothing);
  discrete_state.assign(runs * static_cast<std::size_t>(plan.nz), nothing);
  modes.assign(runs * plan.leaves.size(), 0);
  for (const Tap& tap : plan.taps) {
    const Shape shape = plan.node(tap.node).shape;
    const std::size_t rows = runs * std::max<std::size_t>(times.size(), 1);
    signals.push_back({tap.name, shape,
                       std::vector<double>(rows * static_cast<std::size_t>(shape.size), nothing)});
  }
}

void Outcomes::take(Index number, const Results& results) {
  const auto run = static_cast<std::size_t>(number);
  status[run] = static_cast<int>(results.status);
  message[run] = results.message, block[run] = results.block;
  end_time[run] = results.context.time();
  wall_time[run] = results.statistics.wall_time;
  events[run] = results.statistics.events, steps[run] = results.statistics.steps;
  if (results.status != Status::failed) {
    put(continuous_state, run, results.context.continuous_state());
    put(discrete_state, run, results.context.discrete_state());
  }
  std::ranges::copy(
      results.context.modes(),
      modes.begin() + static_cast<std::ptrdiff_t>(run * results.context.modes().size()));
  // a run that failed has rows, but none of its end; one that could not begin has no signals
  if (results.signals.empty() || (times.empty() && results.status == Status::failed)) return;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const RecordedSignal& signal = results.signals[i];
    const std::vector<double>& rows = results.time_of(signal);
    if (!rows.empty()) take_signal(signals[i], signal, run, rows);
  }
}

void Outcomes::take_signal(Signal& signal, const RecordedSignal& from, std::size_t run,
                           const std::vector<double>& rows) const {
  const auto width = static_cast<std::size_t>(signal.shape.size);
  const std::size_t count = std::max<std::size_t>(times.size(), 1);
  for (std::size_t k = 0; k < count; ++k) {
    const auto row = times.empty() ? std::optional(rows.size() - 1) : row_at(rows, times[k]);
    if (!row) continue;
    std::copy_n(from.values.begin() + static_cast<std::ptrdiff_t>(*row * width), width,
                signal.values.begin() + static_cast<std::ptrdiff_t>((run * count + k) * width));
  }
}

}  // namespace saltus
