// Execution: when a part of a diagram is executed.
#pragma once

#include "saltus/model/event.hpp"

namespace saltus {

/// When a part of a diagram is executed: while its control signal is true, or at the edges of its
/// control signal. The control signal is a scalar that is held between instants; it is true if it
/// is not 0.
struct Execution {
  enum class Kind {
    enabled,   ///< while the control signal is true
    triggered  ///< at each edge of the control signal
  };

  Kind kind = Kind::enabled;
  /// Enabled: whether all states of the part return to their declared initial values each time the
  /// control signal becomes true during a run. Otherwise they continue from where they rested.
  bool resets = false;
  Edge edge = Edge::rising;  ///< triggered: the edges that count
};

}  // namespace saltus
