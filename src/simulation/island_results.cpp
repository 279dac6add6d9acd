// IslandRuns: one event log, and one sum of counts, of all islands.
#include <algorithm>

#include "saltus/simulation/detail/island_runs.hpp"

namespace saltus {

namespace {

void add(Statistics& sum, const Statistics& one) {
  sum.steps += one.steps, sum.rejected += one.rejected, sum.restarts += one.restarts;
  sum.linear_setups += one.linear_setups;
  sum.right_hand_side_calls += one.right_hand_side_calls, sum.guard_calls += one.guard_calls;
  sum.jacobian_calls += one.jacobian_calls;
  sum.events += one.events, sum.instants += one.instants;
}

/// Adds a word to a list without repeats.
void add_word(std::string& list, const std::string& word) {
  if (word.empty() || list == word) return;
  if (list.empty())
    list = word;
  else if (list.find(word) == std::string::npos)
    list += text(", ", word);
}

}  // namespace

const Results& IslandRuns::results() const noexcept {
  if (!under_way_) merge();
  return results_;
}

Results IslandRuns::take_results() {
  merge();
  Results taken = std::move(results_);
  results_ = {};
  renew();
  results_.status = taken.status, results_.message = taken.message, results_.block = taken.block;
  results_.cause = taken.cause, results_.context = taken.context;
  return taken;
}

/// Empty columns.
void IslandRuns::renew() const {
  results_.time.clear(), results_.jump.clear();
  results_.signals.clear(), results_.islands.clear();
  results_.events.begin(names_);
  results_.statistics = {};
  for (const Tap& tap : plan_->taps) {
    const int island = islands_.of_leaf[plan_->node(tap.node).leaf];
    results_.signals.push_back({tap.name, plan_->node(tap.node).shape, {}, table_ ? -1 : island});
  }
  for (const std::vector<int>& leaves : islands_.leaves) {
    IslandResults& island = results_.islands.emplace_back();
    island.name = plan_->leaf(leaves.front()).path, island.blocks = leaves.size();
  }
}

/// Appends the rows and events that the islands have made since the last call.
void IslandRuns::merge() const {
  if (std::exchange(merged_, true)) return;
  if (table_)
    merge_table();
  else
    for (std::size_t k = 0; k < all_.size(); ++k) merge_rows(k);
  merge_events();
  merge_statistics();
}

void IslandRuns::merge_rows(std::size_t k) const {
  Island& island = all_[k];
  const Results& from = island.run->results();
  IslandResults& to = results_.islands[k];
  const auto first = static_cast<std::ptrdiff_t>(island.rows);
  to.time.insert(to.time.end(), from.time.begin() + first, from.time.end());
  to.jump.insert(to.jump.end(), from.jump.begin() + first, from.jump.end());
  for (std::size_t i = 0; i < island.signals.size(); ++i) {
    const RecordedSignal& signal = from.signals[i];
    std::vector<double>& values = nth(results_.signals, island.signals[i]).values;
    values.insert(values.end(), signal.values.begin() + first * signal.shape.size,
                  signal.values.end());
  }
  island.rows = from.time.size();
}

/// All islands that record have a row at each requested time; an island that failed may have fewer.
/// The jump of a row is the sum over the islands that record.
void IslandRuns::merge_table() const {
  const Results* first = nullptr;
  std::size_t rows = 0, seen = 0;
  for (const Island& island : all_) {
    if (island.signals.empty()) continue;
    const Results& from = island.run->results();
    rows = first ? std::min(rows, from.time.size()) : from.time.size();
    first = first ? first : &from, seen = island.rows;
  }
  if (first == nullptr) return;
  for (std::size_t r = seen; r < rows; ++r)
    results_.time.push_back(first->time[r]), results_.jump.push_back(0);
  for (Island& island : all_) {
    const Results& from = island.run->results();
    for (std::size_t i = 0; i < island.signals.size(); ++i) {
      const RecordedSignal& signal = from.signals[i];
      const auto width = static_cast<std::ptrdiff_t>(signal.shape.size);
      std::vector<double>& values = nth(results_.signals, island.signals[i]).values;
      values.insert(values.end(), signal.values.begin() + static_cast<std::ptrdiff_t>(seen) * width,
                    signal.values.begin() + static_cast<std::ptrdiff_t>(rows) * width);
    }
    if (island.signals.empty()) continue;
    for (std::size_t r = seen; r < rows; ++r)
      results_.jump[results_.jump.size() - rows + r] += from.jump[r];
    island.rows = rows;
  }
}

/// The events by time, then by island, then as their island logged them. The global jump is the sum
/// of the jumps of all islands.
void IslandRuns::merge_events() const {
  struct Logged {
    double time;
    std::size_t island, event;
  };
  std::vector<Logged> places;
  int jump = 0;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const EventLog& log = all_[k].run->results().events;
    for (std::size_t i = all_[k].events; i < log.size(); ++i)
      places.push_back({log.row(i).time, k, i});
    all_[k].events = log.size();
    jump += all_[k].jump;
  }
  std::ranges::stable_sort(places, {}, &Logged::time);
  for (const Logged& place : places) {
    Island& island = all_[place.island];
    const EventLog& log = island.run->results().events;
    const EventLog::Row& row = log.row(place.event);
    jump += row.jump - std::exchange(island.jump, row.jump);
    results_.events.append(log, place.event, nth(island.sources, row.source), jump);
  }
}

void IslandRuns::merge_statistics() const {
  Statistics sum;
  List<std::int64_t> counts(names_.size(), 0);
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const Statistics& one = all_[k].run->results().statistics;
    add(sum, one), add_word(sum.method, one.method);
    add_word(sum.linear_solver, one.linear_solver);
    results_.islands[k].statistics = one;
    std::size_t source = 0;  // the counts are in the order of the sources
    for (const auto& [name, count] : one.events_by_name) {
      while (names_[nth(all_[k].sources, source)].full() != name) ++source;
      counts[nth(all_[k].sources, source)] = count;
    }
  }
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (counts[i] > 0) sum.events_by_name.emplace_back(names_[i].full(), counts[i]);
  sum.wall_time = wall_time_;
  results_.statistics = std::move(sum);
}

/// Counts the island under way, so that the progress of the run shows it.
void IslandRuns::count_running() const {
  if (running_ == nullptr) return;
  Statistics sum = finished_;
  add(sum, running_->results().statistics);
  results_.statistics = std::move(sum);
}

}  // namespace saltus
