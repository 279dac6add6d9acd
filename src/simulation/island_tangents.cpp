#include "saltus/simulation/detail/island_tangents.hpp"

#include <algorithm>

#include "saltus/simulation/detail/tangent_gaps.hpp"
#include "sensitivity_entries.hpp"

namespace saltus {

namespace {

/// The number of the leaf to which an entry belongs.
int leaf_with(const Plan& plan, const ContextEntry& entry) {
  using Kind = ContextEntry::Kind;
  const auto has = [&](Index first, Index size) {
    return first <= entry.first && entry.first < first + size;
  };
  const auto found = std::ranges::find_if(plan.leaves, [&](const PlanLeaf& leaf) {
    return entry.kind == Kind::parameter          ? has(leaf.p, leaf.np)
           : entry.kind == Kind::continuous_state ? has(leaf.x, leaf.nx)
                                                  : has(leaf.z, leaf.nz);
  });
  return static_cast<int>(found - plan.leaves.begin());
}

}  // namespace

Layout IslandTangents::layout_of(const Plan& plan) {
  Layout layout;
  for (const PlanLeaf& leaf : plan.leaves)
    layout.leaves.push_back({leaf.path, leaf.x, leaf.nx, leaf.z, leaf.nz, leaf.p, leaf.np,
                             leaf.declared().parameters, leaf.declared().continuous.names});
  layout.computed = plan.computed;
  return layout;
}

IslandTangents::IslandTangents(const Plan& plan, const Islands& islands,
                               std::vector<std::string> names, Results& results)
    : plan_(&plan),
      islands_(&islands),
      results_(&results),
      names_(std::move(names)),
      asked_(islands.count()),
      columns_(islands.count()) {
  const Layout layout = names_.empty() ? Layout() : layout_of(plan);
  for (const SensitivityEntry& one : chosen_entries(names_, layout))
    parameters_.push_back(one.name);
  std::size_t column = 0;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const ContextEntry entry = find_entry(layout, names_[i]);
    const int leaf = leaf_with(plan, entry);
    for (std::size_t k = 0; k < islands.count(); ++k) {
      if (!std::ranges::binary_search(islands.leaves[k], leaf)) continue;
      asked_[k].push_back(i);
      for (Index e = 0; e < entry.size; ++e)
        columns_[k].push_back(column + static_cast<std::size_t>(e));
    }
    column += static_cast<std::size_t>(entry.size);
  }
}

std::vector<std::string> IslandTangents::names_of(std::size_t k) const {
  std::vector<std::string> names;
  for (const std::size_t i : asked_[k]) names.push_back(names_[i]);
  return names;
}

void IslandTangents::renew(double since) {
  Sensitivities& out = results_->sensitivities;
  out = {};
  out.parameters = parameters_;
  if (!empty()) out.signals.resize(plan_->taps.size());
  since_ = since;
}

void IslandTangents::append(std::size_t k, const double* values, double other,
                            std::vector<double>& out) const {
  const std::size_t first = out.size();
  out.resize(first + parameters_.size(), other);
  for (std::size_t j = 0; j < columns_[k].size(); ++j) out[first + columns_[k][j]] = values[j];
}

void IslandTangents::add_rows(std::size_t k, const Results& from, const Rows& rows) {
  if (empty()) return;
  const auto width = static_cast<std::size_t>(from.signals[rows.from].shape.size);
  const std::size_t m = columns_[k].size();
  const double* values = m == 0 ? nullptr : from.sensitivities.signals[rows.from].data();
  std::vector<double>& out = nth(results_->sensitivities.signals, rows.to);
  for (std::size_t i = rows.first * width; i < rows.last * width; ++i)
    append(k, values + i * m, 0.0, out);
}

void IslandTangents::add_event(std::size_t k, const Results& from, std::size_t event) {
  if (empty()) return;
  const std::size_t m = columns_[k].size();
  const bool enters = from.events[event].kind == EventKind::zeno_enter;
  const auto at = [&](const std::vector<double>& values) { return values.data() + event * m; };
  append(k, at(from.sensitivities.event_times), 0.0, results_->sensitivities.event_times);
  append(k, at(from.sensitivities.predicted), enters ? 0.0 : TangentGaps::none,
         results_->sensitivities.predicted);
}

void IslandTangents::begin_end() {
  parts_.clear();
  if (empty()) return;
  Sensitivities& out = results_->sensitivities;
  const auto zeros = [&](Index entries) {
    return std::vector<double>(static_cast<std::size_t>(entries) * parameters_.size(), 0.0);
  };
  out.continuous_state = zeros(plan_->nx), out.discrete_state = zeros(plan_->nz);
  std::erase_if(out.gaps, [&](const SensitivityGap& gap) { return gap.time > since_; });
}

void IslandTangents::finish(std::size_t k, const Results& from) {
  parts_.push_back(part_of(k, from));
  if (columns_[k].empty()) return;
  const Sensitivities& own = from.sensitivities;
  Sensitivities& out = results_->sensitivities;
  write_state(k, own.continuous_state, &PlanLeaf::x, &PlanLeaf::nx, out.continuous_state);
  write_state(k, own.discrete_state, &PlanLeaf::z, &PlanLeaf::nz, out.discrete_state);
  for (const SensitivityGap& gap : own.gaps)
    if (gap.time > since_) out.gaps.push_back(gap);
}

/// An island without columns has no derivatives of its own.
TangentTrajectory::Part IslandTangents::part_of(std::size_t k, const Results& from) const {
  if (from.sensitivities.trajectory.empty()) return {};
  std::vector<Index> columns(columns_[k].begin(), columns_[k].end());
  return {std::make_shared<const TangentTrajectory>(from.sensitivities.trajectory),
          std::move(columns)};
}

void IslandTangents::end() {
  const auto kept = [](const TangentTrajectory::Part& part) { return part.of != nullptr; };
  if (std::ranges::any_of(parts_, kept))
    results_->sensitivities.trajectory = TangentTrajectory::of_parts(parts_);
  std::ranges::stable_sort(results_->sensitivities.gaps, {}, &SensitivityGap::time);
}

/// The leaves of an island follow each other in its own state as they do in the list. An island that
/// failed at its start has no derivatives of a state.
void IslandTangents::write_state(std::size_t k, const std::vector<double>& from,
                                 Index PlanLeaf::*offset, Index PlanLeaf::*size,
                                 std::vector<double>& to) const {
  const std::size_t m = columns_[k].size();
  std::size_t row = 0;
  for (const int number : islands_->leaves[k]) {
    const PlanLeaf& leaf = plan_->leaf(number);
    const auto first = static_cast<std::size_t>(leaf.*offset);
    for (std::size_t i = 0; i < static_cast<std::size_t>(leaf.*size); ++i, ++row) {
      for (std::size_t j = 0; j < m; ++j)
        to[(first + i) * parameters_.size() + columns_[k][j]] =
            row * m + j < from.size() ? from[row * m + j] : TangentGaps::none;
    }
  }
}

}  // namespace saltus
