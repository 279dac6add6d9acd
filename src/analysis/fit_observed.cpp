// What a run says in place of the data.
#include <algorithm>

#include "fit_data.hpp"
#include "run_states.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The times of the events of a run, and their derivatives.
FitModel event_times(const Results& results, const std::string& name, std::optional<EventKind> kind,
                     Index count) {
  const auto events = events_called(results.events, name, kind);
  FitModel found{VectorXd(static_cast<Index>(events.size())), {}};
  for (std::size_t k = 0; k < events.size(); ++k) {
    const Event event = results.events[events[k]];
    found.values[static_cast<Index>(k)] =
        kind == EventKind::zeno_enter ? event.predicted : event.time;
  }
  found.derivatives =
      count > 0 ? event_derivatives(results, name, kind) : MatrixXd(found.values.size(), 0);
  return found;
}

/// The time of an event that the run does not have: at its end, or at the predicted Zeno time.
FitModel beyond(const Observed& seen, const Results& results, Index count) {
  const bool released =
      !seen.kind && events_called(results.events, seen.name, EventKind::zeno_release).empty();
  if (released) {
    const FitModel entered = event_times(results, seen.name, EventKind::zeno_enter, count);
    if (entered.values.size() > 0)
      return {entered.values.tail(1), entered.derivatives.bottomRows(1)};
  }
  return {VectorXd::Constant(1, seen.end), MatrixXd::Zero(1, count)};
}

FitModel model_of_events(const Observed& seen, const Results& results, Index count) {
  const FitModel found = event_times(results, seen.name, seen.kind, count);
  const FitModel last = beyond(seen, results, count);
  FitModel model{VectorXd(seen.data.size()), MatrixXd(seen.data.size(), count)};
  for (Index i = 0; i < seen.data.size(); ++i) {
    const Index k = nth(seen.entry, i);
    const bool there = k < found.values.size();
    model.values[i] = there ? found.values[k] : last.values[0];
    model.derivatives.row(i) = there ? found.derivatives.row(k) : last.derivatives.row(0);
  }
  return model;
}

FitModel model_of_signal(const Observed& seen, const Results& results, Index count) {
  const auto signal = std::ranges::find(results.signals, seen.recorded, &RecordedSignal::name);
  const auto number = static_cast<std::size_t>(signal - results.signals.begin());
  const Index width = signal->shape.size;
  FitModel model{VectorXd(seen.data.size()), MatrixXd(seen.data.size(), count)};
  for (Index i = 0; i < seen.data.size(); ++i) {
    const Index at = nth(seen.row, i) * width + nth(seen.entry, i);
    model.values[i] = nth(signal->values, at);
    for (Index k = 0; k < count; ++k)
      model.derivatives(i, k) = nth(results.sensitivities.signals[number], at * count + k);
  }
  return model;
}

}  // namespace

FitModel Observed::model(const Results& results, Index count) const {
  return is_event ? model_of_events(*this, results, count) : model_of_signal(*this, results, count);
}

}  // namespace saltus
