// Run: how it ends, and the state that a failure leaves.
#include "saltus/base/detail/forced_unwind.hpp"
#include "saltus/simulation/detail/run.hpp"

namespace saltus {

void Run::require_ready(double t_end) const {
  if (begin_.modes().empty())
    throw ModelError("advance_to: the run has no values yet; call initialize(context) first");
  if (begun_ && results_.status == Status::failed) {
    throw ModelError(text("t = ", time_,
                          " s: this run has failed; initialize(results.context) "
                          "goes on from its last accepted state"));
  }
  if (!(t_end >= time_)) {
    throw ModelError(text("cannot run from t = ", time_, " s back to t = ", t_end,
                          " s; the end has to be later"));
  }
}

Status Run::end_chattering() {
  const EventName name = instant_.journal().last_event();
  results_.block = name.block;
  const bool executed = instant_.executions().set_off();
  const auto span = text(chattering_.found().count, executed ? " events in " : " times in ",
                         time_ - chattering_.found().since, " s: time does not advance. ");
  if (executed) {
    return end(Status::chattering,
               text("t = ", time_, " s: executions follow each other, the last of them of '",
                    name.event, "' of block '", name.block, "', ", span,
                    "Give it a longer delay, or a trigger that its executions do not set off"));
  }
  return end(
      Status::chattering,
      text("t = ", time_, " s: guard '", name.event, "' of block '", name.block, "' fired ", span,
           "Give it hysteresis, a zeno_tolerance above 0 s, or a mode of its own for the "
           "motion along the switching surface"));
}

Status Run::end_crawl() {
  const Crawl::Jump& jump = crawl_.jump();
  const PlanLeaf& leaf = leaf_of_state(jump.state);
  results_.block = leaf.path;
  return end(Status::chattering,
             text("t = ", time_, " s: ", jump.steps, " steps took ", jump.took,
                  " s, because the derivative of state x[", jump.state - leaf.x, "] of block '",
                  leaf.path, "' jumps from ", jump.below, " to ", jump.above, " where x[",
                  jump.state - leaf.x, "] = ", jump.at,
                  ": the solution slides along the jump, and no step passes it. Write the branch "
                  "as a relation or as two modes with a guard each, with a mode of its own for the "
                  "motion along the jump, or make it steep but continuous"));
}

/// The step is taken back: the run ends at its begin, the last state before the pole.
void Run::fail_at_pole(double from) {
  const Poles::Pole& pole = poles_->pole();
  const PlanLeaf& leaf = leaf_of_state(pole.state);
  const double to = std::exchange(time_, from);
  machine_.x = poles_->departed_from();
  accepted_.place = Place::machine;
  throw SimulationError(
      text("t = ", from, " s: the derivative of state x[", pole.state - leaf.x, "] of block '",
           leaf.path, "' has a pole at t = ", pole.t,
           " s, where a divisor crosses zero: a step to ", to,
           " s passed it, and its ends do not show it. Expected: a derivative that stays finite. "
           "If it does, choose a smaller rtol and atol; if not, end the run before the pole, for "
           "example with a terminal guard where the divisor is small"),
      from, leaf.path);
}

const PlanLeaf& Run::leaf_of_state(Index state) const {
  return *std::ranges::find_if(plan().leaves, [&](const PlanLeaf& each) {
    return each.x <= state && state < each.x + each.nx;
  });
}

/// Ends the run with an error. Called in a handler: the present exception is the cause.
void Run::fail(std::string message) {
  results_.status = Status::failed;
  results_.message = std::move(message);
  results_.cause = std::current_exception();
  take_accepted();
}

/// Puts the last accepted state into the machine. An instant under way is undone with its rows.
void Run::take_accepted() {
  if (std::exchange(accepted_.in_instant, false)) {
    instant_.undo();
    rows_.shorten(accepted_.rows);
  } else {
    guards_.arm_again(guards_.fired_at_root);  // the instant at the end of the step has not begun
  }
  if (accepted_.place != Place::solver) return;
  try {
    integration_.take_state(time_);
  } catch (...) {  // what failed is in the results; the state is that of the step
    detail::pass_end_of_thread();
    machine_.x = integration_.state();
  }
}

Status Run::end(Status status, std::string message) {
  over_ = true;
  results_.status = status;
  results_.message = std::move(message);
  return status;
}

}  // namespace saltus
