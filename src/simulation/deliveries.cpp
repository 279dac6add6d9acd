// Deliveries: firings, and the reset maps that they reach.
#include "saltus/simulation/detail/deliveries.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/plan/detail/event_wiring.hpp"
#include "saltus/simulation/detail/calendar.hpp"
#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

Deliveries::Deliveries(Machine& machine, Transition& transition, Present& present)
    : machine_(&machine),
      transition_(&transition),
      present_(&present),
      any_(machine.plan().event_wires.any()) {}

void throw_no_such_wire(const Plan& plan, const PendingDelivery& one) {
  throw ModelError(text("the context is not one of this system: a delivery waits of event ",
                        one.event, ", entry ", one.entry, ", of block '", plan.leaf(one.leaf).path,
                        "', from which no event wire with a delay of ", one.delay,
                        " s starts; create the context with system.create_context()"));
}

// --- from run to run

int batch_of(const Plan& plan, const PendingDelivery& one) {
  const EventWires& wires = plan.event_wires;
  const int source = detail::event_source_of(plan, one.leaf, one.event, one.entry);
  if (!wires.any() || source < 0) return -1;
  for (int batch = wires.first_batch[source]; batch < wires.first_batch[source + 1]; ++batch)
    if (wires.batches[batch].delay == one.delay) return batch;
  return -1;
}

PendingDelivery pending_of(const Plan& plan, int batch, double due) {
  const EventWires::Batch& of = plan.event_wires.batches[batch];
  const detail::EventOrigin from = detail::event_origin_of(plan, of.source);
  return {from.leaf, from.event, from.entry, of.delay, due};
}

void Deliveries::require_fits(const Context& context) const {
  if (context.pending() == nullptr) return;
  for (const PendingDelivery& one : context.pending()->deliveries) {
    if (batch_of(plan(), one) < 0) throw_no_such_wire(plan(), one);
  }
}

void Deliveries::begin(const Context& from) {
  if (!any_) return;
  queue_.clear(), outside_.clear();
  fired_.clear(), arriving_.clear();
  if (from.pending() == nullptr) return;
  for (const PendingDelivery& one : from.pending()->deliveries)
    queue_.add(one.due, batch_of(plan(), one));
  queue_.open();
}

std::vector<PendingDelivery> Deliveries::save() const {
  std::vector<PendingDelivery> saved;
  for (const auto& [key, number] : queue_.waiting())
    saved.push_back(pending_of(plan(), number, key.first));
  return saved;
}

void Deliveries::open() {
  queue_.open(), outside_.open();
  fired_.clear(), arriving_.clear();
  delivered_ = set_off_ = false;
}

// --- in an instant

void Deliveries::fire(int source) {
  if (!wires().sends_outside.empty() && wires().sends_outside[source] != 0) {
    outside_.fire(source, present_->t);
    set_off_ = set_off_ || delivered_;
  }
  for (int batch = wires().first_batch[source]; batch < wires().first_batch[source + 1]; ++batch) {
    const double delay = wires().batches[batch].delay;
    if (delay == 0.0) {
      fired_.push_back(batch);
      continue;
    }
    const std::int64_t number = queue_.add(present_->t + delay, batch);
    if (Tangents* tangents = transition_->tangents()) tangents->waiting().wait(number);
    set_off_ = set_off_ || delivered_;
  }
}

/// What is due up to this time [s] is due now.
double Deliveries::now() const { return present_->t + Calendar::slack(present_->t); }

void Deliveries::add_due(std::vector<DueNow>& all) const {
  for (const auto& [key, batch] : queue_.waiting()) {
    if (key.first > now()) break;
    all.push_back({{WaitingKey::Queue::deliveries, key.second},
                   detail::event_name(plan(), wires().batches[batch].source)});
  }
}

bool Deliveries::collect() {
  while (queue_.next() <= now()) {
    const std::int64_t number = queue_.waiting().begin()->first.second;
    fired_.push_back(queue_.take());
    if (Tangents* tangents = transition_->tangents())
      tangents->waiting().take_delivery(
          number, detail::event_name(plan(), wires().batches[fired_.back()].source));
  }
  for (const int number : fired_) {
    const EventWires::Batch& batch = wires().batches[number];
    for (int target = batch.first; target < batch.last; ++target)
      arriving_.push_back(wires().targets[target]);
  }
  outside_.take(now(), arriving_);
  if (!std::ranges::is_sorted(arriving_, {}, &EventWires::Target::number))
    std::ranges::stable_sort(arriving_, {}, &EventWires::Target::number);
  fired_.clear();
  delivered_ = delivered_ || !arriving_.empty();
  return !arriving_.empty();
}

void Deliveries::run() {
  for (const EventWires::Target& target : arriving_)
    transition_->deliver({target.leaf, target.input, target.entry, target.weight, present_->t});
  arriving_.clear();
}

}  // namespace saltus
