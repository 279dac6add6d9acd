// Short runs with the derivative of the end by the start.
#include "pieces.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

Pieces::Pieces(OrbitRuns& runs, const Context& start, std::vector<bool> labels)
    : runs_(runs), states_(start), labels_(std::move(labels)) {
  for (Index i = 0; i < states_.size(); ++i) {
    if (nth(labels_, i)) continue;
    active_.push_back(i), names_.push_back(states_.name(i));
  }
  SimulatorOptions options = runs.shared_options();
  options.sensitivity = names_;
  simulator_.emplace(runs.plan(), std::move(options));
}

std::optional<Piece> Pieces::run(const Context& begin, double duration, double latest) {
  for (int i = 1;; ++i, duration *= elsewhere) {
    const Results& results = moving(begin, duration, latest);
    const Eigen::MatrixXd derivatives = derivatives_of(results);
    const auto& gaps = results.sensitivities.gaps;
    const bool at_event =
        std::ranges::find(gaps, results.context.time(), &SensitivityGap::time) != gaps.end();
    if (!derivatives.allFinite() && at_event && i < piece_tries) continue;
    refuse_gap(runs_.where(), results, names_, derivatives);
    if (!labels_hold(derivatives, results.context)) return {};
    Piece piece{derivatives(active_, Eigen::all), results.context.time() - begin.time(),
                results.context, !results.events.empty()};
    for (std::size_t k = 0; k < results.events.size(); ++k)
      piece.rested = piece.rested || results.events[k].kind == EventKind::zeno_enter;
    return piece;
  }
}

const Results& Pieces::moving(const Context& begin, double duration, double latest) {
  simulator_->initialize(begin);
  double end = begin.time() + duration;
  while (true) {
    const Status status = simulator_->advance_to(end);
    const Results& results = simulator_->results();
    runs_.require_reached(results, status);
    const std::vector<std::string> resting = at_rest(results.context, states_);
    if (resting.empty()) return results;
    if (end >= latest) refuse_rest(resting, results);
    end = std::min(end + duration, latest);
  }
}

void Pieces::refuse_rest(const std::vector<std::string>& resting, const Results& results) const {
  std::string event;
  for (std::size_t k = 0; k < results.events.size(); ++k) {
    const Event one = results.events[k];
    if (one.kind == EventKind::zeno_enter) event = text(" after '", one.block, ".", one.name, "'");
  }
  const double at = results.context.time();
  SimulationError error(
      text(runs_.where(), ": t = ", at, " s: ", quoted(resting), " came to rest", event,
           " and did not move again; expected a system that goes on: a state at rest has no "
           "exponents"),
      at);
  error.attach(std::make_shared<Results>(results));
  throw error;
}

/// Takes what is not whole any more, or depends on an active state, from the labels.
bool Pieces::labels_hold(const Eigen::MatrixXd& derivatives, const Context& end) {
  const Eigen::VectorXd values = RunStates::of(end);
  bool hold = true;
  for (Index i = 0; i < values.size(); ++i) {
    const bool moved =
        std::fmod(values[i], 1.0) != 0.0 || (derivatives.row(i).array() != 0.0).any();
    if (!nth(labels_, i) || !moved) continue;
    labels_[static_cast<std::size_t>(i)] = false, hold = false;
  }
  return hold;
}

}  // namespace saltus
