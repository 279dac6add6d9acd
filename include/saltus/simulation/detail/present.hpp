// Present: the results of the parts of an instant so far. Each part reads them and adds its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "saltus/simulation/detail/thresholds.hpp"
#include "saltus/solver/detail/guard.hpp"

namespace saltus {

/// What an instant came to.
struct Outcome {
  bool restart = false;  ///< f is another function, or x another state: the solver begins anew
  bool terminal = false;
  bool stuck = false;      ///< a guard at rest, without monitor, fires again as soon as it can
  bool flutters = false;   ///< a relation flipped three times or more: both sides lead back
  bool zeno_stop = false;  ///< a Zeno point of a guard that stops there
  bool chatters = false;   ///< it does not end, though no state was written
  int events = 0;          ///< how many events it had
  /// [s] within which an event may follow
  double horizon = std::numeric_limits<double>::infinity();
};

/// Why something happens.
enum class Cause {
  crossing,  ///< a zero crossing fired
  edge,      ///< a watched signal has an edge
  time,      ///< a time event is due
  zeno       ///< firings accumulate, and the guard's author named a mode to enter
};

/// One thing to do in the next pass.
struct Action {
  int leaf;
  Cause cause;
  int index;   ///< of the guard group, the edge or the scheduled event; of a Zeno point its source
  int slot;    ///< the guard of a crossing
  int from;    ///< the side a crossing came from; of a Zeno point the mode to enter
  bool carry;  ///< the reset map of a block on hold, applied again
};

/// What the present instant knows of one guard beyond its record.
struct GuardNow {
  double g_minus = 0.0;  ///< its value where its root was located
  /// [s] from its last firing to this one, where it was not seen clearly off zero in between;
  /// otherwise NaN
  double flight = std::numeric_limits<double>::quiet_NaN();
  int flips = 0;               ///< of a relation, in this instant
  bool fired = false;          ///< in this instant
  bool fired_in_pass = false;  ///< in this pass
  bool frozen = false;         ///< a relation: it keeps its side through this instant
  bool turned = false;         ///< a relation: its side changed when it was read again
};

/// The time of an instant, how far the run still goes, and what is found pass by pass.
struct Present {
  explicit Present(std::size_t guards) : now(guards), g(guards, 1.0) {}

  /// An instant begins: nothing has been found yet.
  void open(double time, double rest_of_run) {
    t = time, longest = rest_of_run, pass = 0;
    firings.clear(), actions.clear();
    std::ranges::fill(now, GuardNow{});
    outcome = {};
  }

  double t = 0.0;        ///< [s]
  double longest = 0.0;  ///< [s] from here to the end of the run
  int pass = 0;
  std::vector<Firing> firings = {};  ///< for the pass to come
  std::vector<Action> actions = {};  ///< likewise
  std::vector<GuardNow> now;         ///< of each guard
  std::vector<double> g;             ///< the guards at (t, x)
  Outcome outcome = {};

  void fire(std::size_t k, int from) { firings.push_back({static_cast<int>(k), from}); }
  /// [s] A shorter flight drowns in the rounding of the time.
  double least_time() const { return thresholds::time_roundings * thresholds::eps * std::abs(t); }
  /// How far the location of a root left a guard from zero. Not where it fired on leaving its error
  /// after a flight: errors made of errors would grow without end.
  double location_error(std::size_t k) const {
    return std::isnan(now[k].flight) ? thresholds::location_error * std::abs(now[k].g_minus)
                                     : thresholds::kept_error * std::abs(g[k]);
  }
};

}  // namespace saltus
