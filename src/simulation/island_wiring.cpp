// IslandSchedule: which event wires lead between islands, and what waits for a context.
#include <algorithm>

#include "saltus/plan/detail/event_wiring.hpp"
#include "saltus/simulation/detail/island_schedule.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

IslandSchedule::IslandSchedule(const Plan& plan, const Islands& islands,
                               std::vector<RunBySteps*> runs)
    : plan_(&plan),
      islands_(&islands),
      runs_(std::move(runs)),
      numbers_(plan.leaves.size(), -1),
      sources_(runs_.size()),
      inside_(plan.event_wires.batches.size(), 0),
      outside_(plan.event_wires.batches.size(), 0),
      shortest_(std::numeric_limits<double>::infinity()) {
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    const std::vector<int>& leaves = islands.leaves[k];
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (islands.of_leaf[leaves[i]] == static_cast<int>(k))
        numbers_[leaves[i]] = static_cast<int>(i);
    find_sources(k);
  }
  for (std::size_t i = 0; i < plan.event_wires.batches.size(); ++i) find_ends(i);
}

/// The sources of an island that send to others.
void IslandSchedule::find_sources(std::size_t k) {
  const Plan& part = runs_[k]->plan();
  const List<char>& sends = part.event_wires.sends_outside;
  sources_[k].assign(sends.size(), -1);
  for (std::size_t source = 0; source < sends.size(); ++source) {
    if (sends[source] == 0) continue;
    const detail::EventOrigin from = detail::event_origin_of(part, static_cast<int>(source));
    const int leaf = nth(islands_->leaves[k], from.leaf);
    sources_[k][source] = detail::event_source_of(*plan_, leaf, from.event, from.entry);
  }
}

/// Where the wires of a batch lead.
void IslandSchedule::find_ends(std::size_t number) {
  const EventWires::Batch& batch = plan_->event_wires.batches[number];
  const int own = island_of(detail::event_origin_of(*plan_, batch.source).leaf);
  for (int i = batch.first; i < batch.last; ++i) {
    const bool inside = island_of(plan_->event_wires.targets[i].leaf) == own;
    (inside ? inside_ : outside_)[number] = 1;
    if (!inside) shortest_ = std::min(shortest_, batch.delay);
  }
}

/// Refuses delays that are within rounding of the time, because no window could be so short.
void IslandSchedule::require_apart(double t_end) const {
  const double t = std::max(std::abs(runs_.front()->time()), std::abs(t_end));
  if (shortest_ > thresholds::window_slacks * Calendar::slack(t)) return;
  const auto& batches = plan_->event_wires.batches;
  std::size_t i = 0;
  while (outside_[i] == 0 || batches[i].delay != shortest_) ++i;
  const detail::EventOrigin from = detail::event_origin_of(*plan_, batches[i].source);
  throw ModelError(text(
      "islands: an event wire from block '", plan_->leaf(from.leaf).path, "' has a delay of ",
      shortest_, " s, which cannot be told apart from none at t = ", t,
      " s; expected a delay above ", thresholds::window_slacks * Calendar::slack(t),
      " s between islands; give it a delay of 0, which joins the blocks, or take islands = false"));
}

void IslandSchedule::begin(const Context& from) {
  sent_.clear();
  time_ = from.time();
  next_.assign(runs_.size(), std::numeric_limits<double>::infinity());
  queue_.clear();
  if (from.pending() == nullptr) return;
  for (const PendingDelivery& one : from.pending()->deliveries)
    if (const int batch = batch_of(*plan_, one); outside_[batch] != 0) post(one.due, batch);
}

bool IslandSchedule::is_inside(const PendingDelivery& one) const {
  return inside_[batch_of(*plan_, one)] != 0;
}

std::vector<PendingDelivery> IslandSchedule::waiting(double t) const {
  std::vector<PendingDelivery> all;
  for (auto one = sent_.upper_bound(t + Calendar::slack(t)); one != sent_.end(); ++one) {
    const auto& [due, batch] = *one;
    if (inside_[batch] == 0) all.push_back(pending_of(*plan_, batch, due));
  }
  return all;
}

}  // namespace saltus
