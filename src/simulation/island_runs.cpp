// IslandRuns: the order in which islands run, and the time at which all of them end.
#include "saltus/simulation/detail/island_runs.hpp"

#include <algorithm>
#include <chrono>

#include "sensitivity_entries.hpp"

namespace saltus {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

void IslandRuns::initialize(const Context& context) {
  require_context_of(*plan_, context);
  contexts_.require_fits(context);
  begin_ = {};  // no run, if an island refuses its values
  const Context known = context.with_computed(plan_->computed);
  std::vector<int> jumps;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    Island& island = all_[k];
    island.begin = contexts_.part_of(known, k);
    island.run->initialize(island.begin);
    const Continuation* continuation = island.begin.continuation();
    jumps.push_back(continuation != nullptr ? continuation->jump : 0);
  }
  if (schedule_) schedule_->begin(context);
  begin_ = context;
  time_ = context.time();
  ends_.clear();
  over_ = stopped_ = false, ender_.reset(), interrupt_.begin();
  merger_.begin(jumps);
  results_.status = Status::reached_end, results_.message.clear(), results_.block.clear();
  results_.cause = nullptr;
}

void IslandRuns::functions_replaced() {
  for (Island& island : all_) island.run->functions_replaced();
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
  interrupt_.begin_piece(), under_way_ = true;
  run_all(t_end);
  under_way_ = false;
  merger_.ran(std::chrono::duration<double>(Clock::now() - start).count());
  results_.context = context();
  return leave();
}

/// Returns the status, or throws if the run has not ended well.
Status IslandRuns::leave() {
  if (ended_well(results_.status) || !options_.throw_errors) return results_.status;
  merger_.merge();
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
  progress_.begin();
  if (schedule_) return end_piece(run_wired(t_end));
  t_end = threads() > 1 ? run_side_by_side(t_end) : run_in_turn(t_end);
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
  end_piece(t_end);
}

void IslandRuns::end_piece(double t_end) {
  progress_.end();
  ends_.push_back(t_end);
  time_ = std::max(time_, t_end);
  if (ender_) end_with(*ender_);
}

/// Runs one island after the other to t_end, or to the end of one before. Returns the end of all.
double IslandRuns::run_in_turn(double t_end) {
  for (const std::size_t k : order_) {
    if (stopped_) break;
    const Status status = run_one(k, t_end);
    take_end(k, status, t_end);
    if (status != Status::reached_end) continue;
    stopped_ = interrupt_.asks_between();
    if (stopped_) ender_ = k;
  }
  return t_end;
}

/// Runs one island on the calling thread.
Status IslandRuns::run_one(std::size_t k, double t_end) {
  RunBySteps& run = *all_[k].run;
  progress_.start(run);
  const Status status = run.advance_to(t_end);
  progress_.stop(), progress_.add(run, time_);
  results_.statistics = progress_.counts();
  return status;
}

/// An island that ends before the others ends the run.
void IslandRuns::take_end(std::size_t k, Status status, double& t_end) {
  if (status == Status::reached_end) return;
  const double end = all_[k].run->time();
  if (!ender_ || end < t_end || k < *ender_) ender_ = k;
  t_end = end;
  stopped_ = stopped_ || status == Status::interrupted;
}

/// Runs an island from the start of the run through its earlier pieces to t_end.
void IslandRuns::run_again(std::size_t k, double t_end) {
  RunBySteps& run = *all_[k].run;
  interrupt_.run_again(true);
  run.initialize(all_[k].begin);
  for (const double end : ends_) run.advance_to(std::min(end, t_end));
  run.advance_to(t_end);
  interrupt_.run_again(false);
}

/// The values of all islands. A run that has not advanced has those with which it began.
Context IslandRuns::context() const {
  if (ends_.empty()) return begin_;
  std::vector<Context> parts;
  for (const Island& island : all_) parts.push_back(island.run->context());
  return contexts_.whole_of(begin_, time_, parts);
}

double IslandRuns::time() const noexcept {
  if (schedule_ && under_way_) return std::max(time_, schedule_->time());
  return time_ + progress_.time(time_) / static_cast<double>(all_.size());
}

void IslandRuns::end_with(std::size_t k) {
  over_ = true;
  const Results& last = all_[k].run->results();
  if (stopped_) {  // by the user; the island may have run again since
    results_.status = interrupt_.raised() ? Status::failed : Status::interrupted;
    results_.message = text("t = ", time_, " s: interrupted");
    results_.cause = interrupt_.raised();
    return;
  }
  results_.status = last.status, results_.message = last.message;
  results_.block = last.block, results_.cause = last.cause;
}

const Results& IslandRuns::results() const noexcept {
  if (!under_way_) merger_.merge();
  return results_;
}

Results IslandRuns::take_results() {
  merger_.merge();
  Results taken;
  std::swap(taken, results_);
  merger_.renew(time_);
  results_.status = taken.status, results_.message = taken.message, results_.block = taken.block;
  results_.cause = taken.cause, results_.context = taken.context;
  return taken;
}

}  // namespace saltus
