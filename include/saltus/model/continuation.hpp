// Continuation: the state of a run beyond the values of its context.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "saltus/base/ids.hpp"

namespace saltus {

/// With these values a run that continues from `results.context` has the events of the unbroken
/// run: the side of every guard and relation, the firings that the Zeno monitors have seen, the
/// states that rest. They belong to the context with which they were saved: a context that was
/// changed by hand has none.
struct Continuation {
  /// One guard.
  struct Guard {
    int side = 0, from = 0;
    bool at_zero = false, resting = false;
    double error = 0.0, base = 0.0;
    bool operator==(const Guard&) const = default;
  };
  /// A guard that fired, and that the flow had not taken clearly off zero at its last instant.
  struct Leaving {
    int guard = 0;          ///< its number
    bool waited = false;    ///< whether it began to wait at zero
    double armed_at = 0.0;  ///< [s] when
    double clear_at = 0.0;  ///< [s] when the flow has taken it clearly off zero
    bool operator==(const Leaving&) const = default;
  };
  /// One Zeno monitor.
  struct Firings {
    std::vector<double> times = {};  ///< [s] of the last firings, latest first; at most four
    std::vector<double> after = {};  ///< the values of `states` after the latest
    std::vector<Index> states = {};  ///< the entries of x that rest, or would rest
    double longest = 0.0;            ///< [s] gap since the last release
    bool holding = false;
    bool operator==(const Firings&) const = default;
  };

  /// Blocks at rest on the surface of one guard.
  struct Contact {
    int guard = 0;            ///< its number
    bool pressed_on = true;   ///< the flow led into the surface when it last led anywhere
    double look_ahead = 0.0;  ///< [s] how far the flow was followed for that; 0: not known
    bool operator==(const Contact&) const = default;
  };

  int jump = 0;                        ///< j
  std::vector<double> relations = {};  ///< truth of all relations that are held
  std::vector<Guard> guards = {};
  std::vector<Firings> firings = {};  ///< of the guards, then of the watched edges
  std::vector<int> edges = {};        ///< watched signals: true (1) or false (0)
  std::vector<Contact> contacts = {};
  std::vector<Leaving> leaving = {};
  std::vector<std::int64_t> counts = {};  ///< firings of each guard, for max_count
  /// Of each island of a run with the option islands. All other lists are then empty, and `jump` is
  /// the sum.
  std::vector<Continuation> islands = {};
  bool settled = true;  ///< of an island: the events at its time have happened
  bool operator==(const Continuation&) const = default;
};

}  // namespace saltus
