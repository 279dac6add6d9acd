// Deliveries: what event wires carry from the event of one leaf to the reset map of another.
#pragma once

#include <string>
#include <vector>

#include "saltus/model/context.hpp"
#include "saltus/simulation/detail/delivery_queue.hpp"
#include "saltus/simulation/detail/outside_wires.hpp"
#include "saltus/simulation/detail/present.hpp"
#include "saltus/simulation/detail/tangent_waits.hpp"
#include "saltus/simulation/detail/transition.hpp"

namespace saltus {

/// The batch of wires of a pending delivery; -1 if the plan has no such wires.
int batch_of(const Plan& plan, const PendingDelivery& one);
/// The inverse: a batch of wires whose deliveries are due at this time [s].
PendingDelivery pending_of(const Plan& plan, int batch, double due);
/// Throws ModelError for a pending delivery that no wire of the plan makes.
[[noreturn]] void throw_no_such_wire(const Plan& plan, const PendingDelivery& one);

/// Notes the events that fire, and applies the reset maps of their targets: in the next pass, or
/// after the delay of the wires. A scene without event wires asks `any`, and nothing else.
class Deliveries {
 public:
  Deliveries(Machine& machine, Transition& transition, Present& present);

  /// Whether the scene has event wires.
  bool any() const noexcept { return any_; }
  /// Throws ModelError for pending deliveries of wires that the scene does not have.
  void require_fits(const Context& context) const;
  /// A run begins with the deliveries that wait in a context.
  void begin(const Context& from);
  /// The deliveries that wait, for a context.
  std::vector<PendingDelivery> save() const;
  void open();
  void undo() { queue_.undo(), outside_.undo(); }

  /// [s] The time at which the next delivery of a wire inside the plan is due; infinite if none waits.
  double next() const noexcept { return queue_.next(); }
  /// What comes from other islands, and goes to them. A context does not have it.
  OutsideWires& outside() noexcept { return outside_; }
  const OutsideWires& outside() const noexcept { return outside_; }
  /// A guard, by its place among all guards, or a time event fires.
  void fire_guard(Index slot) { fire(static_cast<int>(slot)); }
  void fire_time_event(int event) { fire(static_cast<int>(plan().guard_slots) + event); }
  /// Adds those that are due now.
  void add_due(std::vector<DueNow>& all) const;
  /// Finds the deliveries of the pass to come. False if there is none.
  bool collect();
  /// Applies the reset maps of these, one after the other, in the order of their wires.
  void run();
  /// Whether something was delivered in this instant.
  bool delivered() const noexcept { return delivered_; }
  /// Whether a delivery of this instant was followed by a firing that is delivered later.
  bool set_off() const noexcept { return set_off_; }

 private:
  const Plan& plan() const { return machine_->plan(); }
  const EventWires& wires() const { return plan().event_wires; }
  void fire(int source);
  double now() const;

  Machine* machine_;
  Transition* transition_;
  Present* present_;
  bool any_;
  DeliveryQueue queue_;
  OutsideWires outside_;
  std::vector<int> fired_;                    // batches without a delay that fired in this pass
  std::vector<EventWires::Target> arriving_;  // targets of the pass to come
  bool delivered_ = false, set_off_ = false;
};

}  // namespace saltus
