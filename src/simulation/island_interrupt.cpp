// Islands ask the user whether the run goes on.
#include "saltus/simulation/detail/island_interrupt.hpp"

#include "saltus/base/detail/forced_unwind.hpp"

namespace saltus {

bool IslandInterrupt::asks() {
  if (again_) return false;
  if (!is_on_caller()) return stop_;
  if (!ask_) return false;
  const auto now = Clock::now();
  if (now - asked_ < std::chrono::milliseconds(20)) return false;
  asked_ = now;
  note_();
  return ask_user();
}

/// Where the user's function returns true or throws, the islands on other threads stop too.
bool IslandInterrupt::ask_user() {
  try {
    if (ask_()) stop_ = true;
  } catch (...) {
    stop_ = true;
    throw;
  }
  return stop_;
}

bool IslandInterrupt::asks_between() {
  try {
    return asks();
  } catch (...) {
    detail::pass_end_of_thread();
    raised_ = std::current_exception();
    return true;
  }
}

}  // namespace saltus
