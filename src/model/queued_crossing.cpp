// The members of a queued ZeroCrossing, and the errors in them.
#include <cmath>

#include "saltus/model/event.hpp"

namespace saltus {

namespace {

bool has_one_direction(Direction direction) {
  return direction == Direction::positive_then_non_positive ||
         direction == Direction::negative_then_non_negative;
}

std::string fault_of_numbers(const ZeroCrossing& c) {
  if (c.delay && c.delay->is_constant()) {
    const double delay = c.delay->constant();
    if (!(delay >= 0.0) || std::isinf(delay))
      return text("has a delay of ", delay, " s; expected a finite time >= 0 s");
  }
  if (c.priority && c.priority->is_constant() && std::isnan(c.priority->constant()))
    return "has a priority that is not a number; expected a number";
  return {};
}

/// Whether the crossing needs a guard with one firing side: to see that the trigger goes back, or
/// to count it as true before the start.
std::string fault_of_direction(const ZeroCrossing& c) {
  const bool needs_side = c.is_cancelled_on_return() || c.initial_value;
  if (!needs_side || has_one_direction(c.direction)) return {};
  return text(c.initial_value ? "has an initial_value" : "is not persistent",
              ", and its direction is ", to_string(c.direction),
              ": it has no firing side; expected positive_then_non_positive or "
              "negative_then_non_negative");
}

std::string fault_of_monitor(const ZeroCrossing& c) {
  if (c.on_zeno.kind() == OnZeno::Kind::hold && !c.zeno_tolerance && c.holds.empty()) return {};
  return "is queued, so it has no Zeno monitor, and on_zeno, zeno_tolerance and holds mean "
         "nothing; "
         "leave them out, or declare a contact as a zero crossing without delay, priority and "
         "persistent";
}

}  // namespace

AtStart ZeroCrossing::wish(bool at_start_of_run) const {
  if (!at_start_of_run || !initial_value) return at_start;
  return *initial_value ? AtStart::ignore : AtStart::fire;
}

std::string ZeroCrossing::queue_fault() const {
  if (terminal)
    return "is queued and terminal; expected one of them: let a zero crossing of its own end the "
           "run";
  if (!has_effect())
    return "is queued and has neither a reset map nor an end_mode, so nothing would be executed; "
           "give it one of them, or leave out delay, priority and the like for a monitor";
  if (initial_value && at_start != AtStart::automatic)
    return "has an initial_value and an at_start; expected one of them";
  if (use_values_from_trigger_time.value_or(false) && !reset_map)
    return "uses values from its trigger time and has no reset map that computes them";
  for (const auto fault : {fault_of_numbers, fault_of_direction, fault_of_monitor})
    if (std::string found = fault(*this); !found.empty()) return found;
  return {};
}

}  // namespace saltus
