// IslandRuns: a run for each island, and the options that it has.
#include <algorithm>
#include <numeric>

#include "saltus/simulation/detail/island_runs.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "width.hpp"

namespace saltus {

namespace {

Tolerance tolerance_of(const Tolerance& tolerance, const Plan& plan,
                       const std::vector<int>& leaves) {
  if (!tolerance.by_state()) return tolerance;
  std::vector<double> each;
  for (const int i : leaves) {
    const PlanLeaf& leaf = plan.leaf(i);
    for (Index x = leaf.x; x < leaf.x + leaf.nx; ++x) each.push_back(tolerance[x]);
  }
  return each;
}

bool has_terminal_guard(const Plan& plan) {
  return std::ranges::any_of(plan.leaves, [](const PlanLeaf& leaf) {
    return std::ranges::any_of(leaf.declared().zero_crossings, &ZeroCrossing::terminal);
  });
}

/// The names of all sources of events with their numbers, sorted.
std::vector<std::pair<std::string, int>> numbered(const std::vector<EventName>& names) {
  std::vector<std::pair<std::string, int>> all;
  for (const EventName& name : names) all.emplace_back(name.full(), std::ssize(all));
  std::ranges::sort(all);
  return all;
}

}  // namespace

IslandRuns::IslandRuns(std::shared_ptr<const Plan> plan, Islands islands, SimulatorOptions options)
    : plan_(std::move(plan)),
      islands_(std::move(islands)),
      options_(std::move(options)),
      contexts_(*plan_, islands_),
      merger_(plan_, islands_, !options_.save_at.empty() && !options_.event_rows,
              options_.sensitivity, results_),
      interrupt_(options_.interrupt, [this] { results_.statistics = counts(); }) {
  detail::check(options_);
  require_widths(options_, *plan_);
  const auto sources = numbered(merger_.names());
  all_.reserve(islands_.count());
  for (std::size_t k = 0; k < islands_.count(); ++k) add_island(k, options_, sources);
  if (islands_.are_wired()) {
    std::vector<RunBySteps*> runs;
    for (const Island& island : all_) runs.push_back(island.run.get());
    schedule_.emplace(*plan_, islands_, std::move(runs));
    contexts_.wire(*schedule_);
  }
  order_.resize(all_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::stable_sort(order_, std::greater<>(),
                           [&](std::size_t k) { return all_[k].terminal; });
}

SimulatorOptions IslandRuns::options_for(std::size_t k, const SimulatorOptions& options) {
  const std::vector<int>& leaves = islands_.leaves[k];
  SimulatorOptions own = options;
  own.sensitivity = merger_.sensitivity_of(k);
  own.rtol = tolerance_of(options.rtol, *plan_, leaves);
  own.atol = tolerance_of(options.atol, *plan_, leaves);
  own.islands = false, own.island_threads = 1, own.throw_errors = false;
  own.interrupt = [this] { return interrupt_.asks(); };
  return own;
}

void IslandRuns::add_island(std::size_t k, const SimulatorOptions& options,
                            const std::vector<std::pair<std::string, int>>& sources) {
  const std::shared_ptr<const Plan> part = plan_of_island(*plan_, islands_, k);
  Island island{.run = std::make_unique<RunBySteps>(part, options_for(k, options)),
                .terminal = has_terminal_guard(*part)};
  contexts_.add(*part);
  std::vector<int> numbers;
  for (const EventName& name : event_names(*part))
    numbers.push_back(
        std::ranges::lower_bound(sources, name.full(), {}, &std::pair<std::string, int>::first)
            ->second);
  merger_.add(
      {.run = island.run.get(), .sources = std::move(numbers), .signals = islands_.taps[k]});
  all_.push_back(std::move(island));
}

std::string IslandRuns::describe() const {
  std::string out = plan_->describe() + islands_.describe();
  for (std::size_t k = 0; k < std::min<std::size_t>(all_.size(), 3); ++k)
    out += text("  island of '", results_.islands[k].name, "': ", islands_.blocks(k),
                " of the blocks; ", all_[k].run->describe());
  return out + (all_.size() > 3 ? "  ...\n" : "");
}

}  // namespace saltus
