// Decisions of the queue: what a trigger does, when an execution is due, and which comes first.
// They are functions of values. The rules are those of events in SBML Level 3 Version 2, section
// 4.11.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// What the firing of the guard of a queued zero crossing does.
///
///     declared direction   came from          then
///     one direction        its armed side     schedule an execution
///     one direction        its firing side    cancel the execution that waits, if there is one
///     any other            either side        schedule an execution
enum class OnTrigger { schedule, cancel };

constexpr OnTrigger decide_trigger(Direction declared, int from) {
  const bool one = declared == Direction::positive_then_non_positive ||
                   declared == Direction::negative_then_non_negative;
  return one && from == firing_side(declared) ? OnTrigger::cancel : OnTrigger::schedule;
}

/// Whether a number may be a delay [s]: finite, and not negative.
inline bool is_delay(double delay) { return delay >= 0.0 && std::isfinite(delay); }

/// The priority of an execution that declares none: after all that declare one.
inline constexpr double no_priority = -std::numeric_limits<double>::infinity();

/// The position of the execution that comes first: the one of highest priority; of several equal
/// ones number floor(n u), where `draw()` gives u in (0, 1). It draws only if there are several.
template <class Draw>
std::size_t choose_first(std::span<const double> priorities, const Draw& draw) {
  double highest = priorities.front();
  std::size_t equal = 0;
  for (const double each : priorities) {
    if (each > highest) highest = each, equal = 0;
    equal += each == highest;
  }
  std::size_t skip = equal > 1 ? static_cast<std::size_t>(static_cast<double>(equal) * draw()) : 0;
  for (std::size_t i = 0;; ++i)
    if (priorities[i] == highest && skip-- == 0) return i;
}

/// Counts how far the executions of an instant set each other off. An instant without end has a
/// chain without end, or passes without end after an execution; many executions that were due
/// anyway make no chain, and neither do the passes that each of them sets off.
struct ExecutionChain {
  int executions = 0;     ///< in this instant
  int longest = 0;        ///< executions of the longest chain
  int last = 0;           ///< length of the chain that the last execution ended
  int passes = 0;         ///< up to the last execution, with its own
  int triggers = 0;       ///< passes of nothing but triggers since then
  int trigger_pass = -1;  ///< the last of these

  /// The length of the chain of an execution that is scheduled now.
  int next() const { return last + 1; }
  /// An execution with a chain of this length is carried out in this pass, 0 for the first.
  void execute(int length, int pass) {
    ++executions, last = length, passes = pass + 1, triggers = 0;
    if (length > longest) longest = length;
  }
  /// Triggers are all that happens in this pass.
  void trigger(int pass) { triggers += std::exchange(trigger_pass, pass) != pass; }
  /// Passes that max_passes does not count: those up to the last execution, but for its longest
  /// chain, and those of triggers, which change nothing.
  int beside() const { return passes - longest + triggers; }
};

}  // namespace saltus
