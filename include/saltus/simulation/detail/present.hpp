// Present: the results of the parts of an instant so far. Each part reads them and adds its own.
#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "saltus/base/list.hpp"
#include "saltus/simulation/detail/error_bound.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// The result of an instant.
struct Outcome {
  bool restart = false;  ///< f or x has changed: the solver begins anew
  bool terminal = false;
  bool stuck = false;      ///< a guard at rest without a monitor fires again at once
  bool flutters = false;   ///< a relation flipped three times or more
  bool zeno_stop = false;  ///< a guard that stops the run at a Zeno point reached one
  bool chatters = false;   ///< its passes do not end, though no state was written
  int events = 0;          ///< number of its events
  /// [s] within which an event may follow
  double horizon = std::numeric_limits<double>::infinity();
};

/// Why something happens.
enum class Cause {
  crossing,  ///< a zero crossing fired
  trigger,   ///< a queued zero crossing fired
  edge,      ///< a watched signal has an edge
  time,      ///< a time event is due
  zeno,      ///< firings accumulate, and the guard's author named a mode to enter
  execution  ///< an execution of a queued zero crossing is due
};

/// One action of the next pass.
struct Action {
  int leaf;
  Cause cause;
  int index;   ///< the guard group, edge or scheduled event; the source of a Zeno point
  int slot;    ///< the guard of a crossing
  int from;    ///< the side a crossing came from; the mode a Zeno point enters
  bool carry;  ///< the reset map of a block on hold, applied again
};

/// The facts about one guard in the present instant, beyond its record.
struct GuardNow {
  double location = 0.0;  ///< error of its value by the location of its root; 0 where it jumped
  /// [s] from its last firing to this one; NaN if it was clearly off zero in between
  double flight = std::numeric_limits<double>::quiet_NaN();
  double clear_after = 0.0;         ///< [s] the flow takes it clearly off zero within this time
  int flips = 0;                    ///< flips of a relation in this instant
  double jump = 0.0;                ///< the size of its jump at its root; 0: none
  double before = 0.0;              ///< edge_detection: its value before its root
  bool entered = false;             ///< it can fire since this instant, and could not before
  bool fired = false;               ///< it fired in this instant
  bool fired_in_pass = false;       ///< it fired in this pass
  bool frozen = false;              ///< a relation: it keeps its side through this instant
  bool turned = false;              ///< a relation: its side changed when it was read again
  bool put_at_zero = false;         ///< the last commit moved it to zero, within its error
  bool turned_beside_root = false;  ///< at zero at the root of another guard, and turned to its
                                    ///< armed side, to which the flow took it

  bool jumped() const noexcept { return jump > 0.0; }
};

/// The time of an instant, the time left of the run, and the findings pass by pass.
class Present {
 public:
  explicit Present(std::size_t guards) : g(guards, 1.0), now_(guards), is_noted_(guards, 0) {}

  /// An instant begins: nothing has been found yet. Guards without facts cost nothing.
  void open(double time, double rest_of_run) {
    t = time, longest = rest_of_run, pass = 0;
    firings.clear(), actions.clear();
    for (const std::size_t k : noted_) now_[k] = {}, is_noted_[k] = 0;
    noted_.clear(), fired_in_pass_.clear();
    outcome = {}, contact_changed = placed = false;
  }
  /// A pass begins: no guard has fired in it yet.
  void open_pass() {
    for (const std::size_t k : fired_in_pass_) now_[k].fired_in_pass = false;
    fired_in_pass_.clear();
  }

  /// The facts about guard k.
  const GuardNow& now(std::size_t k) const { return now_[k]; }
  /// Whether anything is noted of guard k in this instant.
  bool has_facts(std::size_t k) const { return is_noted_[k] != 0; }
  /// The same, to be written.
  GuardNow& note(std::size_t k) {
    if (!std::exchange(is_noted_[k], 1)) noted_.push_back(k);
    return now_[k];
  }
  /// Guard k fires in this pass.
  void fires_in_pass(std::size_t k) {
    GuardNow& now = note(k);
    now.fired = now.fired_in_pass = true;
    fired_in_pass_.push_back(k);
  }
  /// The mode of guard k is entered. What it did in an earlier stay in this mode, in the same instant, is over.
  void enters(std::size_t k) {
    GuardNow& now = note(k);
    now.entered = true, now.fired = false;
  }
  /// Guard k did not fire: it only seemed to.
  void take_back(std::size_t k) {
    GuardNow& now = note(k);
    now.fired = now.fired_in_pass = false;
    now.jump = 0.0;
  }

  double t = 0.0;        ///< [s]
  double longest = 0.0;  ///< [s] from here to the end of the run
  int pass = 0;
  bool changes = false;          ///< whether the pass to come changes something; else it only logs
  bool contact_changed = false;  ///< a contact is carried now, or has a wider error: it has to
                                 ///< be armed, though nothing is committed
  bool placed = false;           ///< a block was put at rest on its surface since the last commit
  std::vector<Firing> firings = {};  ///< for the pass to come
  std::vector<Action> actions = {};  ///< likewise
  std::vector<double> g;             ///< the guards at (t, x)
  Outcome outcome = {};

  void fire(std::size_t k, int from) { firings.push_back({static_cast<int>(k), from}); }
  /// [s] A shorter flight is within the rounding of the time.
  double least_time() const { return thresholds::time_roundings * thresholds::eps * std::abs(t); }
  /// The error bound of a guard before the flow is asked.
  double error_so_far(std::size_t k, bool counts_as_zero = false) const {
    return saltus::error_so_far({.g = g[k],
                                 .location = now_[k].location,
                                 .fired = now_[k].fired,
                                 .left_error = !std::isnan(now_[k].flight),
                                 .counts_as_zero = counts_as_zero});
  }

 private:
  std::vector<GuardNow> now_;
  List<char> is_noted_;                     // whether a guard is in noted_
  std::vector<std::size_t> noted_;          // guards with facts
  std::vector<std::size_t> fired_in_pass_;  // guards that fired in this pass
};

}  // namespace saltus
