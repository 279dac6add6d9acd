// IslandRuns: the order in which islands run, and the time at which all of them end.
#include "saltus/simulation/detail/island_runs.hpp"

#include <algorithm>
#include <numeric>

#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/simulation/detail/option_table.hpp"
#include "width.hpp"

namespace saltus {

namespace {

using Clock = std::chrono::steady_clock;

/// Throws ModelError for an option that islands do not have yet.
void require_supported(const SimulatorOptions& options, const Islands& islands) {
  const auto refuse = [&](std::string_view option, std::string_view instead) {
    throw ModelError(text("option ", option, ": not supported with islands = true in a system of ",
                          islands.count(), " islands; ", instead));
  };
  if (options.dense_output)
    refuse("dense_output", "name the times in save_at, or run it with islands = false");
  if (!options.sensitivity.empty()) refuse("sensitivity", "run it with islands = false");
}

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
      names_(event_names(*plan_)),
      table_(!options_.save_at.empty() && !options_.event_rows) {
  detail::check(options_);
  require_widths(options_, *plan_);
  require_supported(options_, islands_);
  const auto sources = numbered(names_);
  all_.reserve(islands_.count());
  for (std::size_t k = 0; k < islands_.count(); ++k) add_island(k, options_, sources);
  order_.resize(all_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::stable_sort(order_, std::greater<>(),
                           [&](std::size_t k) { return all_[k].terminal; });
  renew();
}

SimulatorOptions IslandRuns::options_for(const std::vector<int>& leaves,
                                         const SimulatorOptions& options) {
  SimulatorOptions own = options;
  own.rtol = tolerance_of(options.rtol, *plan_, leaves);
  own.atol = tolerance_of(options.atol, *plan_, leaves);
  own.islands = false, own.throw_errors = false;
  own.interrupt = [this] { return interrupted(); };
  return own;
}

void IslandRuns::add_island(std::size_t k, const SimulatorOptions& options,
                            const std::vector<std::pair<std::string, int>>& sources) {
  const std::shared_ptr<const Plan> part = plan_of_island(*plan_, islands_, k);
  Island island{.run = std::make_unique<Run>(part, options_for(islands_.leaves[k], options)),
                .terminal = has_terminal_guard(*part)};
  auto layout = std::make_shared<Layout>();
  for (const PlanLeaf& leaf : part->leaves)
    layout->leaves.push_back(
        {leaf.path, leaf.x, leaf.nx, leaf.z, leaf.nz, leaf.p, leaf.np, leaf.declared().parameters});
  island.layout = std::move(layout);
  for (const EventName& name : event_names(*part))
    island.sources.push_back(
        std::ranges::lower_bound(sources, name.full(), {}, &std::pair<std::string, int>::first)
            ->second);
  island.signals = islands_.taps[k];
  for (const PlanLeaf& leaf : part->leaves) {
    if (std::ranges::any_of(leaf.declared().zero_crossings, &ZeroCrossing::is_queued))
      queue_ = static_cast<int>(k);
  }
  all_.push_back(std::move(island));
}

void IslandRuns::initialize(const Context& context) {
  require_context_of(*plan_, context);
  require_fits(context);
  begin_ = {};  // no run, if an island refuses its values
  for (std::size_t k = 0; k < all_.size(); ++k) {
    Island& island = all_[k];
    Context begin = part_of(context, k);
    island.run->initialize(begin);
    island.rows = island.events = 0;
    island.jump = begin.continuation() ? begin.continuation()->jump : 0;
    island.begin = std::move(begin);
  }
  begin_ = context;
  time_ = context.time(), wall_time_ = 0.0;
  ends_.clear();
  over_ = stopped_ = false, ender_.reset(), raised_ = nullptr, merged_ = true;
  renew();
  results_.status = Status::reached_end, results_.message.clear(), results_.block.clear();
  results_.cause = nullptr;
}

void IslandRuns::functions_replaced() {
  for (Island& island : all_) island.run->functions_replaced();
}

std::string IslandRuns::describe() const {
  std::string out = plan_->describe() + islands_.describe();
  for (std::size_t k = 0; k < std::min<std::size_t>(all_.size(), 3); ++k)
    out += text("  island of '", plan_->leaf(islands_.leaves[k].front()).path,
                "': ", islands_.leaves[k].size(), " of the blocks; ", all_[k].run->describe());
  return out + (all_.size() > 3 ? "  ...\n" : "");
}

void IslandRuns::require_ready(double t_end) const {
  if (begin_.modes().empty())
    throw ModelError("advance_to: the run has no values yet; call initialize(context) first");
  if (over_ && results_.status == Status::failed) {
    throw ModelError(text("t = ", time_,
                          " s: this run has failed; initialize(results.context) "
                          "goes on from its last accepted state"));
  }
  if (!(t_end >= time_)) {
    throw ModelError(text("cannot run from t = ", time_, " s back to t = ", t_end,
                          " s; the end has to be later"));
  }
}

Status IslandRuns::advance_to(double t_end) {
  require_ready(t_end);
  if (over_) return leave();
  const auto start = Clock::now();
  asked_ = start, under_way_ = true;
  run_all(t_end);
  under_way_ = false;
  wall_time_ += std::chrono::duration<double>(Clock::now() - start).count();
  merged_ = false;
  results_.context = context();
  return leave();
}

/// Returns the status, or throws if the run has not ended well.
Status IslandRuns::leave() {
  if (ended_well(results_.status) || !options_.throw_errors) return results_.status;
  merge();
  const auto partial = std::make_shared<Results>(results_);
  partial->cause = nullptr;  // otherwise the error would own itself
  try {
    if (results_.cause) std::rethrow_exception(results_.cause);
    throw SimulationError(results_.message, time_, results_.block);
  } catch (SimulationError& error) {
    error.attach(partial);
    throw;
  }
}

/// Runs all islands to t_end, or to the earliest end that one of them has.
void IslandRuns::run_all(double t_end) {
  const double begin = time_;
  finished_ = {}, finished_time_ = 0.0;
  for (const std::size_t k : order_) {
    if (!stopped_) run_one(k, t_end);
  }
  if (stopped_) {
    for (const Island& island : all_) t_end = std::min(t_end, island.run->time());
  }
  for (bool cut = true; cut;) {
    cut = false;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (all_[k].run->time() <= t_end) continue;
      run_again(k, t_end);
      if (all_[k].run->time() < t_end) t_end = all_[k].run->time(), ender_ = k, cut = true;
    }
  }
  running_ = nullptr, finished_time_ = 0.0;
  ends_.push_back(t_end);
  time_ = std::max(begin, t_end);
  if (ender_) end_with(*ender_);
}

/// Runs one island to t_end; if it ends earlier, that is the new end of all.
void IslandRuns::run_one(std::size_t k, double& t_end) {
  Run& run = *all_[k].run;
  running_ = &run;
  const Status status = run.advance_to(t_end);
  count_running();
  finished_ = results_.statistics, finished_time_ += run.time() - time_;
  running_ = nullptr;
  if (status == Status::reached_end) {
    stopped_ = interrupted_between();
    if (stopped_) ender_ = k;
    return;
  }
  if (!ender_ || run.time() < t_end || k < *ender_) ender_ = k;
  t_end = run.time();
  stopped_ = status == Status::interrupted;
}

/// Runs an island from the start of the run through its earlier pieces to t_end.
void IslandRuns::run_again(std::size_t k, double t_end) {
  Run& run = *all_[k].run;
  again_ = true;  // it cannot be interrupted: it has run so far before
  run.initialize(all_[k].begin);
  for (const double end : ends_) run.advance_to(std::min(end, t_end));
  run.advance_to(t_end);
  again_ = false;
}

/// Whether the user asks the run to stop. An island asks at most every 20 ms of its own run, and
/// many islands are shorter, so this looks at the clock again.
bool IslandRuns::interrupted() {
  if (again_ || !options_.interrupt) return false;
  const auto now = Clock::now();
  if (now - asked_ < std::chrono::milliseconds(20)) return false;
  asked_ = now;
  count_running();
  return options_.interrupt();
}

/// The same between two islands, where no run takes an exception of the user's function.
bool IslandRuns::interrupted_between() {
  try {
    return interrupted();
  } catch (...) {
    detail::pass_end_of_thread();
    raised_ = std::current_exception();
    return true;
  }
}

double IslandRuns::time() const noexcept {
  const double now = running_ ? running_->time() - time_ : 0.0;
  return time_ + (finished_time_ + now) / static_cast<double>(all_.size());
}

void IslandRuns::end_with(std::size_t k) {
  over_ = true;
  const Results& last = all_[k].run->results();
  if (last.status == Status::reached_end) {  // stopped between two islands
    results_.status = raised_ ? Status::failed : Status::interrupted;
    results_.message = text("t = ", time_, " s: interrupted");
    results_.cause = raised_;
    return;
  }
  results_.status = last.status, results_.message = last.message;
  results_.block = last.block, results_.cause = last.cause;
}

}  // namespace saltus
