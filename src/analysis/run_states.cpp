// The states of a system as one vector, and their derivatives in a run.
#include "run_states.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const ByRows> rows_of(const std::vector<double>& values, std::size_t columns) {
  const auto n = static_cast<Index>(columns);
  return {values.data(), n > 0 ? static_cast<Index>(values.size()) / n : 0, n};
}

/// States at rest in islands, whose numbers are those of the island.
void add_islands(std::vector<std::string>& names, const std::vector<Continuation>& islands) {
  for (std::size_t k = 0; k < islands.size(); ++k)
    for (const Continuation::Firings& firing : islands[k].firings)
      for (const Index i : firing.states)
        if (firing.holding) names.push_back(text("state ", i, " of island ", k));
}

}  // namespace

RunStates::RunStates(const Context& context) {
  const Layout& layout = context.layout();
  for (const Layout::Leaf& leaf : layout.leaves) {
    blocks_.push_back(leaf.path);
    for (Index i = 0; i < leaf.nx; ++i) names_.push_back(layout.name_of(leaf, text("x[", i, "]")));
  }
  continuous_ = size();
  for (const Layout::Leaf& leaf : layout.leaves)
    for (Index i = 0; i < leaf.nz; ++i) names_.push_back(layout.name_of(leaf, text("z[", i, "]")));
}

Eigen::VectorXd RunStates::of(const Context& context) {
  const Eigen::VectorXd &x = context.continuous_state(), &z = context.discrete_state();
  Eigen::VectorXd all(x.size() + z.size());
  all << x, z;
  return all;
}

Context RunStates::put(const Context& context, const Eigen::VectorXd& values) const {
  const Context with = context.with_continuous_state(Eigen::VectorXd(values.head(continuous_)));
  if (size() == continuous_) return with;
  return with.with_discrete_state(Eigen::VectorXd(values.tail(size() - continuous_)));
}

Eigen::MatrixXd derivatives_of(const Results& results) {
  const Sensitivities& found = results.sensitivities;
  const auto x = rows_of(found.continuous_state, found.size());
  const auto z = rows_of(found.discrete_state, found.size());
  Eigen::MatrixXd all(x.rows() + z.rows(), static_cast<Index>(found.size()));
  all << x, z;
  return all;
}

std::vector<std::size_t> events_called(const EventLog& log, const std::string& name,
                                       std::optional<EventKind> kind) {
  log.times(name, kind);  // refuses an unknown name
  const std::vector<std::string> paths = log.names();
  const bool path = std::ranges::find(paths, name) != paths.end();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < log.size(); ++i) {
    const Event event = log[i];
    if (!(kind ? event.kind == *kind : is_firing(event.kind))) continue;
    if (name == (path ? text(event.block, ".", event.name) : std::string(event.name)))
      found.push_back(i);
  }
  return found;
}

Eigen::MatrixXd event_derivatives(const Results& results, const std::string& name,
                                  std::optional<EventKind> kind) {
  const Sensitivities& found = results.sensitivities;
  const auto rows =
      rows_of(kind == EventKind::zeno_enter ? found.predicted : found.event_times, found.size());
  const auto events = events_called(results.events, name, kind);
  Eigen::MatrixXd by(static_cast<Index>(events.size()), rows.cols());
  for (std::size_t k = 0; k < events.size(); ++k)
    by.row(static_cast<Index>(k)) = rows.row(static_cast<Index>(events[k]));
  return by;
}

void refuse_gap(const std::string& where, const Results& results,
                const std::vector<std::string>& names, const Eigen::MatrixXd& values) {
  for (Index k = 0; k < values.cols(); ++k) {
    if (values.col(k).allFinite()) continue;
    const std::string& name = nth(names, k);
    const auto& gaps = results.sensitivities.gaps;
    const auto gap = std::ranges::find(gaps, name, &SensitivityGap::parameter);
    const bool known = gap != gaps.end();
    const double time = known ? gap->time : results.context.time();
    const std::string event =
        known && !gap->event.empty() ? text(" at the event '", gap->event, "'") : "";
    SimulationError error(text(where, ": t = ", time, " s: there is no derivative by '", name, "'",
                               event, ": ", known ? gap->reason : "the derivative is not finite",
                               "; start elsewhere, or see docs/derivatives.md for what has none"),
                          time);
    error.attach(std::make_shared<Results>(results));
    throw error;
  }
}

std::vector<std::string> at_rest(const Context& context, const RunStates& states) {
  const Continuation* saved = context.continuation();
  std::set<Index> resting;
  if (saved)
    for (const Continuation::Firings& firing : saved->firings)
      if (firing.holding) resting.insert(firing.states.begin(), firing.states.end());
  std::vector<std::string> names;
  for (const Index i : resting) names.push_back(states.name(i));
  if (saved) add_islands(names, saved->islands);
  return names;
}

std::string quoted(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += text(all.empty() ? "'" : ", '", name, "'");
  return all;
}

}  // namespace saltus
