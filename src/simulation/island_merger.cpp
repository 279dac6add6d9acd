#include "saltus/simulation/detail/island_merger.hpp"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace saltus {

namespace {

/// Adds a word to a list without repeats.
void add_word(std::string& list, const std::string& word) {
  if (word.empty() || list == word) return;
  if (list.empty())
    list = word;
  else if (list.find(word) == std::string::npos)
    list += text(", ", word);
}

}  // namespace

void add_counts(Statistics& sum, const Statistics& one) {
  sum.steps += one.steps, sum.rejected += one.rejected, sum.restarts += one.restarts;
  sum.linear_setups += one.linear_setups;
  sum.right_hand_side_calls += one.right_hand_side_calls, sum.guard_calls += one.guard_calls;
  sum.jacobian_calls += one.jacobian_calls;
  sum.events += one.events, sum.instants += one.instants;
}

IslandMerger::IslandMerger(std::shared_ptr<const Plan> plan, const Islands& islands, bool table,
                           const std::vector<std::string>& sensitivity, Results& results)
    : plan_(std::move(plan)),
      islands_(&islands),
      names_(event_names(*plan_)),
      table_(table),
      results_(&results),
      tangents_(*plan_, islands, sensitivity, results) {
  std::unordered_map<std::string_view, int> island;
  for (std::size_t i = 0; i < plan_->leaves.size(); ++i)
    island.emplace(plan_->leaf(i).path, islands.of_leaf[i]);
  for (const EventName& name : names_) owners_.push_back(island.at(name.block));
  renew();
}

void IslandMerger::begin(const std::vector<int>& jumps) {
  for (std::size_t k = 0; k < parts_.size(); ++k)
    parts_[k].rows = parts_[k].events = 0, parts_[k].jump = jumps[k];
  wall_time_ = 0.0, merged_ = true;
  renew();
}

void IslandMerger::renew(double since) {
  results_->time.clear(), results_->jump.clear();
  results_->signals.clear(), results_->islands.clear();
  results_->events.begin(names_);
  results_->statistics = {};
  for (const Tap& tap : plan_->taps) {
    const int island = islands_->of_leaf[plan_->node(tap.node).leaf];
    results_->signals.push_back({tap.name, plan_->node(tap.node).shape, {}, table_ ? -1 : island});
  }
  for (std::size_t k = 0; k < islands_->count(); ++k) {
    IslandResults& island = results_->islands.emplace_back();
    island.name = plan_->leaf(islands_->first[k]).path, island.blocks = islands_->blocks(k);
  }
  tangents_.renew(since);
  results_->trajectory = {};
  since_ = since;
}

void IslandMerger::merge() {
  if (std::exchange(merged_, true)) return;
  if (table_)
    merge_table();
  else
    for (std::size_t k = 0; k < parts_.size(); ++k) merge_rows(k);
  merge_events();
  merge_statistics();
  merge_tangents();
  merge_trajectories();
}

/// Copies those of all islands, which have grown since the last time.
void IslandMerger::merge_trajectories() {
  std::vector<Trajectory::Part> parts;
  double begin = results_->trajectory.empty() ? since_ : results_->trajectory.begin();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Run& run = *parts_[k].run;
    const Trajectory& own = run.results().trajectory;
    if (own.empty()) return;
    begin = std::max(begin, own.begin());
    Trajectory::Part& part = parts.emplace_back();
    part.of = std::make_shared<const Trajectory>(own), part.signals = parts_[k].signals;
    const std::vector<int>& leaves = islands_->leaves[k];
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const PlanLeaf &from = run.plan().leaf(static_cast<int>(i)), &to = plan_->leaf(leaves[i]);
      if (from.nx > 0) part.states.push_back({from.x, to.x, from.nx});
    }
  }
  results_->trajectory = Trajectory::of_parts(plan_, begin, std::move(parts));
}

/// The final state, and what has no derivative; rows and events were appended with theirs.
void IslandMerger::merge_tangents() {
  tangents_.begin_end();
  for (std::size_t k = 0; k < parts_.size(); ++k) tangents_.finish(k, parts_[k].run->results());
  tangents_.end();
}

void IslandMerger::merge_rows(std::size_t k) {
  Part& island = parts_[k];
  const Results& from = island.run->results();
  IslandResults& to = results_->islands[k];
  const auto first = static_cast<std::ptrdiff_t>(island.rows);
  to.time.insert(to.time.end(), from.time.begin() + first, from.time.end());
  to.jump.insert(to.jump.end(), from.jump.begin() + first, from.jump.end());
  for (std::size_t i = 0; i < island.signals.size(); ++i) {
    const RecordedSignal& signal = from.signals[i];
    std::vector<double>& values = nth(results_->signals, island.signals[i]).values;
    values.insert(values.end(), signal.values.begin() + first * signal.shape.size,
                  signal.values.end());
    tangents_.add_rows(k, from, {i, island.signals[i], island.rows, from.time.size()});
  }
  island.rows = from.time.size();
}

/// All islands that record have a row at each requested time; an island that failed may have fewer.
/// The jump of a row is the sum over the islands that record.
void IslandMerger::merge_table() {
  const Results* first = nullptr;
  std::size_t rows = 0, seen = 0;
  for (const Part& island : parts_) {
    if (island.signals.empty()) continue;
    const Results& from = island.run->results();
    rows = first ? std::min(rows, from.time.size()) : from.time.size();
    first = first ? first : &from, seen = island.rows;
  }
  if (first == nullptr) return;
  for (std::size_t r = seen; r < rows; ++r)
    results_->time.push_back(first->time[r]), results_->jump.push_back(0);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& island = parts_[k];
    const Results& from = island.run->results();
    for (std::size_t i = 0; i < island.signals.size(); ++i) {
      const RecordedSignal& signal = from.signals[i];
      const auto width = static_cast<std::ptrdiff_t>(signal.shape.size);
      std::vector<double>& values = nth(results_->signals, island.signals[i]).values;
      values.insert(values.end(), signal.values.begin() + static_cast<std::ptrdiff_t>(seen) * width,
                    signal.values.begin() + static_cast<std::ptrdiff_t>(rows) * width);
      tangents_.add_rows(k, from, {i, island.signals[i], seen, rows});
    }
    if (island.signals.empty()) continue;
    for (std::size_t r = seen; r < rows; ++r)
      results_->jump[results_->jump.size() - rows + r] += from.jump[r];
    island.rows = rows;
  }
}

/// The events by time, then by island, then as their island logged them; those of a copied source are
/// logged by its first island. The global jump is the sum of the jumps of all islands.
void IslandMerger::merge_events() {
  struct Logged {
    double time;
    std::size_t island, event;
  };
  std::vector<Logged> places;
  int jump = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const EventLog& log = parts_[k].run->results().events;
    for (std::size_t i = parts_[k].events; i < log.size(); ++i)
      places.push_back({log.row(i).time, k, i});
    parts_[k].events = log.size();
    jump += parts_[k].jump;
  }
  std::ranges::stable_sort(places, {}, &Logged::time);
  for (const Logged& place : places) {
    Part& island = parts_[place.island];
    const EventLog& log = island.run->results().events;
    const EventLog::Row& row = log.row(place.event);
    jump += row.jump - std::exchange(island.jump, row.jump);
    if (!owns(place.island, nth(island.sources, row.source))) continue;
    results_->events.append(log, place.event, nth(island.sources, row.source), jump);
    tangents_.add_event(place.island, island.run->results(), place.event);
  }
}

void IslandMerger::merge_statistics() {
  Statistics sum;
  List<std::int64_t> counts(names_.size(), 0);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Statistics& one = parts_[k].run->results().statistics;
    add_counts(sum, one), add_word(sum.method, one.method);
    add_word(sum.linear_solver, one.linear_solver);
    results_->islands[k].statistics = one;
    std::size_t source = 0;  // the counts are in the order of the sources
    for (const auto& [name, count] : one.events_by_name) {
      while (names_[nth(parts_[k].sources, source)].full() != name) ++source;
      counts[nth(parts_[k].sources, source)] = count;
    }
  }
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (counts[i] > 0) sum.events_by_name.emplace_back(names_[i].full(), counts[i]);
  sum.wall_time = wall_time_;
  results_->statistics = std::move(sum);
}

}  // namespace saltus
