// Effects: reset maps, changes of mode, updates.
#include "saltus/simulation/detail/effects.hpp"

namespace saltus {

void Effects::run(const Action& action) {
  if (action.cause == Cause::zeno) return transition_->enter_mode(action.leaf, action.from);
  if (action.cause == Cause::trigger) return executions_->trigger(action);
  const int source = journal_->source_of(action.cause, action.index);
  journal_->cause(source);
  switch (action.cause) {
    case Cause::time:
      return run_update(action, source);
    case Cause::execution:
      return run_execution(action);
    default:
      return run_reset(action, source);
  }
}

void Effects::run_update(const Action& action, int source) {
  const TimeEvent& event = plan_->time_event_of(plan_->scheduled(action.index));
  if (event.update)
    transition_->run({&event.update, action.leaf, 0, present_->t, journal_->name_of(source)});
  journal_->note({.kind = EventKind::time, .source = source, .leaf = action.leaf});
  if (deliveries_->any()) deliveries_->fire_time_event(action.index);
}

void Effects::run_execution(const Action& action) {
  const Index guard = executions_->execute(action);
  if (deliveries_->any()) deliveries_->fire_guard(guard);
}

/// The effect that the author of a zero crossing or an edge declared.
Effects::Effect Effects::effect_of(const Action& action) {
  if (action.cause == Cause::edge) {
    const EdgeReset& reset = edges_->reset_of(action.index);
    return {&reset.reset_map, nullptr, &holds_->of_edge(action.index), reset.reads_before};
  }
  const ZeroCrossing& crossing = plan_->crossing_of(plan_->guards[action.index]);
  return {&crossing.reset_map, crossing.end_mode ? &*crossing.end_mode : nullptr,
          &holds_->of_guard(action.slot), false, crossing.yields};
}

/// Runs the effect of a zero crossing or an edge.
void Effects::run_reset(const Action& action, int source) {
  const Effect effect = effect_of(action);
  if (effect.yields && transition_->changed_in_pass(action.leaf)) return note(action, source);
  Holds::Hold& hold = *effect.hold;
  const bool wrote = write(effect, action.leaf, journal_->name_of(source));
  note(action, source);
  if (!wrote || action.carry) return;
  holds_->fired(hold, present_->t);
  if (holds_->look_for_accumulation(hold) && action.cause == Cause::edge)
    contacts_->keep_relations_of(action.index);
}

/// Runs the reset map of an effect, and enters its mode. Returns whether it wrote a state or a
/// mode.
bool Effects::write(const Effect& effect, int leaf, const std::string& source) {
  const bool wrote = *effect.map && transition_->run({effect.map, leaf, effect.hold->entry,
                                                      present_->t, source, effect.reads_before});
  if (effect.end_mode) transition_->enter_mode(leaf, *effect.end_mode);
  return wrote || effect.end_mode != nullptr;
}

/// Logs the firing of a zero crossing or an edge. It may be the last one of the run.
void Effects::note(const Action& action, int source) {
  const bool last = action.cause == Cause::crossing && journal_->ends_run(action.index);
  present_->outcome.terminal = present_->outcome.terminal || last;
  journal_->note({.kind = last ? EventKind::terminal : EventKind::zero_crossing,
                  .source = source,
                  .leaf = action.leaf,
                  .direction = -action.from,
                  .entry = action.slot < 0 ? 0 : (*guards_)[action.slot].entry});
  if (deliveries_->any() && action.cause == Cause::crossing) deliveries_->fire_guard(action.slot);
}

}  // namespace saltus
