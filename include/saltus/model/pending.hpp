// Pending executions: the queued zero crossings that are scheduled and not executed yet, and the
// firings that event wires have not delivered yet.
#pragma once

#include <cstdint>
#include <vector>

namespace saltus {

/// The values that a reset map computed at the time of its trigger, to be written later. Only the
/// entries that it changed are kept, because all other entries of the leaf change meanwhile.
struct FrozenValues {
  bool wrote_continuous = false, wrote_discrete = false, wrote_mode = false;
  std::vector<int> continuous_entries = {}, discrete_entries = {};
  std::vector<double> continuous = {}, discrete = {};  ///< values of these entries
  int mode = 0;                                        ///< if the map wrote a mode
  bool operator==(const FrozenValues&) const = default;
};

/// One execution that is scheduled.
struct PendingExecution {
  int leaf = 0;             ///< number of the block in the system
  int event = 0;            ///< position of the zero crossing in the block
  int entry = 0;            ///< the guard that fired, in a vector of guards
  double due = 0.0;         ///< [s]
  std::int64_t number = 0;  ///< the number of executions scheduled before it in this run
  bool frozen = false;      ///< whether its values were computed at the trigger
  FrozenValues values = {};
  bool operator==(const PendingExecution&) const = default;
};

/// A firing of an event that event wires with one delay deliver later.
struct PendingDelivery {
  int leaf = 0;        ///< number of the block of the event in the system
  int event = 0;       ///< the zero crossings of the block come first, then its time events
  int entry = 0;       ///< the guard that fired, in a vector of guards
  double delay = 0.0;  ///< [s] of the wires
  double due = 0.0;    ///< [s]
  bool operator==(const PendingDelivery&) const = default;
};

/// All executions that are pending, in the order in which they are due, and the counts that later
/// executions need. A context carries them, also after a value of it was changed by hand.
struct PendingExecutions {
  std::vector<PendingExecution> all = {};
  std::int64_t scheduled = 0;                    ///< executions scheduled so far
  std::int64_t draws = 0;                        ///< ties decided at random so far
  std::vector<PendingDelivery> deliveries = {};  ///< by due time, then in the order of the firings
  bool operator==(const PendingExecutions&) const = default;
};

}  // namespace saltus
