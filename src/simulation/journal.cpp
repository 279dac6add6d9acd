// Journal: the events of a run by name, their order and their number.
#include "saltus/simulation/detail/journal.hpp"

#include <algorithm>
#include <ranges>

namespace saltus {

namespace {

/// Names of declared events that can never fire. A user may still ask for them by name.
void add_silent(const Plan& plan, std::vector<EventName>& names) {
  for (const PlanLeaf& leaf : plan.leaves) {
    for (const ZeroCrossing& crossing : leaf.declared().zero_crossings) {
      if (crossing.direction == Direction::none) names.push_back({leaf.path, crossing.name});
    }
  }
  for (const Node& node : plan.nodes) {
    if (node.relation && !node.located)
      names.push_back({plan.leaf_of(node).path, plan.relation_of(node).name});
  }
}

/// The name of an entry of the plan, "block.event", in its two parts.
template <class Entry>
EventName name_in(const Plan& plan, const Entry& entry) {
  const std::string& block = plan.leaf(entry.leaf).path;
  return {block, entry.name.substr(block.size() + 1)};
}

}  // namespace

std::vector<EventName> event_names(const Plan& plan) {
  std::vector<EventName> names;
  for (const GuardGroup& group : plan.guards) names.push_back(name_in(plan, group));
  for (const EdgeWatch& edge : plan.edges) names.push_back(name_in(plan, edge));
  for (const ScheduledEvent& event : plan.schedule) names.push_back(name_in(plan, event));
  add_silent(plan, names);
  return names;
}

Journal::Journal(const Machine& machine, const Transition& transition,
                 const SimulatorOptions& options, Results& results)
    : machine_(&machine),
      plan_(&machine.plan()),
      transition_(&transition),
      options_(&options),
      results_(&results) {
  counts_.assign(plan_->guards.size() + plan_->edges.size() + plan_->schedule.size(), 0);
  earlier_.assign(plan_->guards.size(), 0);
  results.events.begin(event_names(*plan_));
}

void Journal::begin() {
  last_source_ = -1;
  std::ranges::fill(counts_, 0), std::ranges::fill(earlier_, 0);
  results_->events.clear();
}

void Journal::open(double t) {
  t_ = t, events_ = 0;
  chain_.clear();
  counted_.clear(), logged_ = results_->events.size();
}

void Journal::undo() {
  for (const int source : counted_) --counts_[source];
  counted_.clear();
  results_->statistics.events -= events_;
  results_->events.shorten(logged_);
}

int Journal::source_of(Cause cause, int index) const {
  const auto groups = static_cast<int>(plan_->guards.size()),
             edges = static_cast<int>(plan_->edges.size());
  return cause == Cause::edge   ? groups + index
         : cause == Cause::time ? groups + edges + index
                                : index;
}

const std::string& Journal::name_of(int source) const {
  const auto groups = static_cast<int>(plan_->guards.size()),
             edges = static_cast<int>(plan_->edges.size());
  if (source < groups) return plan_->guard(source).name;
  if (source < groups + edges) return plan_->edge(source - groups).name;
  return plan_->scheduled(source - groups - edges).name;
}

int Journal::leaf_of(int source) const {
  const auto groups = static_cast<int>(plan_->guards.size()),
             edges = static_cast<int>(plan_->edges.size());
  if (source < groups) return plan_->guard(source).leaf;
  if (source < groups + edges) return plan_->edge(source - groups).leaf;
  return plan_->scheduled(source - groups - edges).leaf;
}

void Journal::note(const Entry& entry) {
  ++results_->statistics.events, ++events_;
  last_source_ = entry.source;
  if (is_firing(entry.kind)) {
    ++counts_[entry.source];
    counted_.push_back(entry.source);
  }
  add(entry, t_, jump_, machine_->x.data(), transition_->next().data());
}

void Journal::renew_after() {
  struct Logged {
    EventLog::Row row;
    std::vector<double> before;
    std::vector<Index> rests;
  };
  EventLog& events = results_->events;
  std::vector<Logged> logged;
  std::size_t n = events.size();
  for (; n > 0 && events.row(n - 1).time == t_ && events.row(n - 1).jump == jump_; --n) {
    const Event event = events[n - 1];
    logged.push_back({events.row(n - 1),
                      {event.before.begin(), event.before.end()},
                      {event.rests.begin(), event.rests.end()}});
  }
  events.shorten(n);
  for (const auto& [row, before, rests] : std::views::reverse(logged))
    events.add(row, before.data(), machine_->x.data() + plan_->leaf(leaf_of(row.source)).x, rests);
}

void Journal::note_monitor(const MonitorHit& hit, const Guard& guard, int jump, const double* x) {
  ++counts_[guard.group];
  add({.kind = EventKind::zero_crossing,
       .source = guard.group,
       .leaf = plan_->guard(guard.group).leaf,
       .direction = -hit.firing.from,
       .entry = guard.entry},
      hit.t, jump, x, x);
}

void Journal::add(const Entry& entry, double t, int jump, const double* before,
                  const double* after) {
  if (!options_->record_events) return;
  const PlanLeaf& of = plan_->leaf(entry.leaf);
  results_->events.add({t, jump, entry.direction, entry.kind, entry.source, entry.predicted, 0,
                        static_cast<std::size_t>(of.nx), static_cast<int>(entry.entry)},
                       before + of.x, after + of.x, entry.rests, of.x);
}

void Journal::cause(int source) {
  if (chain_.size() < thresholds::remembered_causes) chain_.push_back(source);
}

bool Journal::ends_run(int group, std::int64_t waiting) const {
  const ZeroCrossing& crossing = plan_->crossing_of(plan_->guards[group]);
  return crossing.terminal && earlier_[group] + counts_[group] + waiting + 1 >= crossing.max_count;
}

std::vector<std::pair<std::string, std::int64_t>> Journal::counts() const {
  std::vector<std::pair<std::string, std::int64_t>> named;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0) named.emplace_back(name_of(static_cast<int>(i)), counts_[i]);
  }
  return named;
}

EventName Journal::last_event() const {
  return last_source_ < 0 ? EventName{} : event_of(last_source_);
}

EventName Journal::event_of(int source) const {
  const auto groups = static_cast<int>(plan_->guards.size()),
             edges = static_cast<int>(plan_->edges.size());
  if (source < groups) return name_in(*plan_, plan_->guard(source));
  if (source < groups + edges) return name_in(*plan_, plan_->edge(source - groups));
  return name_in(*plan_, plan_->scheduled(source - groups - edges));
}

void Journal::throw_no_end() const {
  std::string causes;
  const std::size_t first =
      chain_.size() > thresholds::shown_causes ? chain_.size() - thresholds::shown_causes : 0;
  for (std::size_t i = first; i < chain_.size(); ++i)
    causes += text(i == first ? "'" : " -> '", name_of(chain_[i]), "'");
  const EventName last = chain_.empty() ? EventName{} : event_of(chain_.back());
  throw SimulationError(text("t = ", t_, " s: this instant does not come to an end: more than ",
                             options_->max_passes, " passes; the events set each other off: ... ",
                             causes, " ...; break the loop, or raise max_passes"),
                        t_, last.block);
}

std::vector<std::int64_t> Journal::save() const {
  std::vector<std::int64_t> firings = earlier_;
  for (std::size_t i = 0; i < firings.size(); ++i) firings[i] += counts_[i];
  return firings;
}

}  // namespace saltus
