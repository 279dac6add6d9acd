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

}  // namespace saltus
