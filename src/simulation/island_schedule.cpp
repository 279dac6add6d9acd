// IslandSchedule: the windows of a piece of a run.
#include "saltus/simulation/detail/island_schedule.hpp"

#include <algorithm>
#include <numeric>

#include "saltus/plan/detail/event_wiring.hpp"
#include "saltus/simulation/detail/side_by_side.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

IslandSchedule::End IslandSchedule::run(double t_end, double latest, std::size_t threads,
                                        const std::function<bool()>& asks) {
  require_apart(t_end);
  End end{std::min(t_end, latest)};
  queue_.clear(), next_.assign(runs_.size(), std::numeric_limits<double>::infinity());
  for (RunBySteps* run : runs_) run->begin_piece(t_end);
  window_.resize(runs_.size());
  std::iota(window_.begin(), window_.end(), std::size_t{0});
  close_window(end);
  while (take_window(end)) {
    run_window(end, threads);
    close_window(end);
    if (end.stopped || !asks()) continue;
    end.stopped = true;
    for (const RunBySteps* run : runs_) time_ = std::max(time_, run->time());
    end.time = std::min(end.time, time_);
  }
  finish(end);
  return end;
}

/// The islands that may run up to the end of the next window; false if none is before the end.
bool IslandSchedule::take_window(const End& end) {
  window_.clear();
  const auto is_outdated = [&](const Entry& entry) { return entry.first != next_[entry.second]; };
  const auto pop = [&] {
    std::ranges::pop_heap(queue_, std::greater<>());
    queue_.pop_back();
  };
  while (!queue_.empty() && is_outdated(queue_.front())) pop();
  if (queue_.empty() || queue_.front().first > end.time) return false;
  time_ = queue_.front().first;
  safe_ = time_ + shortest_;
  while (!queue_.empty()) {
    const auto [t, k] = queue_.front();
    if (t > end.time || !Calendar::is_clearly_before(t, safe_)) break;
    if (!is_outdated(queue_.front())) {
      window_.push_back(k);
      next_[k] = std::numeric_limits<double>::infinity();
    }
    pop();
  }
  sent_.erase(sent_.begin(), sent_.lower_bound(time_));
  return true;
}

void IslandSchedule::run_window(const End& end, std::size_t threads) {
  const std::size_t count = window_.size(), block = thresholds::islands_at_once;
  if (threads < 2 || count < threads * block) {
    for (const std::size_t k : window_) runs_[k]->run_window(safe_, end.time);
    return;
  }
  const auto run_block = [&](std::size_t i) {
    for (std::size_t j = i * block; j < std::min(count, (i + 1) * block); ++j)
      runs_[nth(window_, j)]->run_window(safe_, end.time);
  };
  side_by_side((count + block - 1) / block, threads, run_block, [] {});
}

/// What the islands of a window have sent, and when each of them goes on.
void IslandSchedule::close_window(End& end) {
  for (const std::size_t k : window_) post_fired(k), note_end(k, end);
  for (const std::size_t k : window_) enqueue(k);
}

/// An island that ends before the others ends the run; of several the first.
void IslandSchedule::note_end(std::size_t k, End& end) {
  const RunBySteps& run = *runs_[k];
  if (!run.over() || run.time() > end.time) return;
  if (!end.island || run.time() < end.time || k < *end.island) end.island = k;
  end.time = run.time();
}

bool IslandSchedule::has_passed(double t) const {
  return std::ranges::any_of(
      runs_, [&](const RunBySteps* run) { return run->time() > t + Calendar::slack(t); });
}

/// All islands end at the end of the run. A taken step that reaches beyond is cut.
void IslandSchedule::finish(End& end) {
  end.passed = has_passed(end.time);
  for (std::size_t k = 0; k < runs_.size() && !end.passed; ++k) {
    if (!runs_[k]->over()) runs_[k]->cut_at(end.time);
    note_end(k, end);
  }
  end.passed = has_passed(end.time);
  if (end.passed) return;
  for (RunBySteps* run : runs_) run->end_piece();
}

// --- what waits for which island

void IslandSchedule::enqueue(std::size_t k) {
  const double t = runs_[k]->next();
  if (t >= next_[k] || !(t < std::numeric_limits<double>::infinity())) return;
  next_[k] = t;
  queue_.emplace_back(t, k);
  std::ranges::push_heap(queue_, std::greater<>());
}

void IslandSchedule::post_fired(std::size_t k) {
  OutsideWires& outside = runs_[k]->outside();
  const auto& first_batch = plan_->event_wires.first_batch;
  for (const OutsideFiring& firing : outside.fired()) {
    const int source = sources_[k][firing.source];
    for (int batch = first_batch[source]; batch < first_batch[source + 1]; ++batch)
      if (outside_[batch] != 0) post(firing.t + plan_->event_wires.batches[batch].delay, batch);
  }
  outside.forget_fired();
}

/// Gives a firing to the islands of its targets, except its own.
void IslandSchedule::post(double due, int number) {
  const EventWires::Batch& batch = plan_->event_wires.batches[number];
  const int own = island_of(detail::event_origin_of(*plan_, batch.source).leaf);
  for (int i = batch.first; i < batch.last; ++i) {
    EventWires::Target target = plan_->event_wires.targets[i];
    const int island = island_of(target.leaf);
    if (island == own) continue;
    target.leaf = numbers_[target.leaf];
    const auto k = static_cast<std::size_t>(island);
    runs_[k]->outside().put({due, target});
    if (due < next_[k]) enqueue(k);
  }
  sent_.emplace(due, number);
}

}  // namespace saltus
