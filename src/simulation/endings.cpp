// Endings: the messages of runs that end before their end.
#include "saltus/simulation/detail/endings.hpp"

#include <algorithm>

namespace saltus {

Endings::Endings(Machine& machine, const SimulatorOptions& options)
    : machine_(&machine), chattering_(options), crawl_(machine), interrupt_(options) {
  if (Poles::may_be_passed(options)) poles_.emplace(machine, options);
}

void Endings::begin(double t) {
  interrupt_.begin();
  chattering_.begin(t, machine_->x), crawl_.begin(t);
  if (poles_) poles_->begin();
}

const PlanLeaf& Endings::leaf_of(Index state) const {
  return *std::ranges::find_if(machine_->plan().leaves, [&](const PlanLeaf& each) {
    return each.x <= state && state < each.x + each.nx;
  });
}

SimulationError Endings::pole_error(double from, double to) const {
  const Poles::Pole& pole = poles_->pole();
  const PlanLeaf& leaf = leaf_of(pole.state);
  return SimulationError(
      text("t = ", from, " s: the derivative of state x[", pole.state - leaf.x, "] of block '",
           leaf.path, "' has a pole at t = ", pole.t,
           " s, where a divisor crosses zero: a step to ", to,
           " s passed it, and its ends do not show it. Expected: a derivative that stays finite. "
           "If it does, choose a smaller rtol and atol; if not, end the run before the pole, for "
           "example with a terminal guard where the divisor is small"),
      from, leaf.path);
}

std::optional<Endings::Ending> Endings::slides(double t, const Integration& integration) {
  if (!crawl_.found(t, integration.state())) return {};
  const Crawl::Jump& jump = crawl_.jump();
  const PlanLeaf& leaf = leaf_of(jump.state);
  return Ending{
      Status::chattering, leaf.path,
      text("t = ", t, " s: ", jump.steps, " steps took ", jump.took,
           " s, because the derivative of state x[", jump.state - leaf.x, "] of block '", leaf.path,
           "' jumps from ", jump.below, " to ", jump.above, " where x[", jump.state - leaf.x,
           "] = ", jump.at,
           ": the solution slides along the jump, and no step passes it. Write the branch "
           "as a relation or as two modes with a guard each, with a mode of its own for the "
           "motion along the jump, or make it steep but continuous")};
}

std::optional<Endings::Ending> Endings::after_instant(const Outcome& outcome,
                                                      const Chattering::Seen& seen, bool idle,
                                                      const Journal& journal) {
  if (outcome.terminal) return Ending{.status = Status::terminal, .message = {}};
  if (outcome.zeno_stop) return Ending{.status = Status::zeno_stop, .message = {}};
  if (!chattering_.chatters(outcome, seen, idle, machine_->x)) return {};
  return chattering(seen, journal.last_event());
}

Endings::Ending Endings::chattering(const Chattering::Seen& seen, const EventName& name) const {
  const Chattering::Series& series = chattering_.found();
  const std::string span = text(series.count, seen.executed ? " events in " : " times in ",
                                seen.t - series.since, " s: time does not advance. ");
  const std::string guard = text("'", name.event, "' of block '", name.block, "'");
  if (seen.executed)
    return {
        Status::chattering, name.block,
        text("t = ", seen.t, " s: executions, or deliveries, follow each other, the last event is ",
             guard, ", ", span,
             "Give it a longer delay, or a trigger that its executions do not set off")};
  return {Status::chattering, name.block,
          text("t = ", seen.t, " s: guard ", guard, " fired ", span,
               "Give it hysteresis, a zeno_tolerance above 0 s, or a mode of its own for the "
               "motion along the switching surface")};
}

}  // namespace saltus
