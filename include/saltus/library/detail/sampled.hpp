// The base of blocks that read their inputs at ticks, at 0, dt, 2 dt, ... after an offset, and hold
// their output in between: y[k] = output(s[k], u[k]), s[k+1] = next(s[k], u[k]).
#pragma once

#include <functional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// At a tick all outputs change first, in the order of their wires, and then all states, so a row
/// of blocks adds no delay to their own. Between ticks the output does not change, whatever the
/// input does.
class SampledSystem : public LeafSystem {
 protected:
  using LeafSystem::LeafSystem;
  using Map = std::function<void(const At& at, const VectorView& s, VectorRef out)>;

  struct Law {
    double dt = 0.0;                    ///< [s], or inherited_period
    bool may_inherit = false;           ///< whether the maps do without dt
    Value before = 0.0;                 ///< y before the first tick; its shape is that of y
    Eigen::VectorXd state = {};         ///< s[0]
    std::vector<int> feedthrough = {};  ///< the inputs that `output` reads
    bool boolean = false;               ///< y is 0 or 1
    Map output = {}, next = {};
    double offset = 0.0;  ///< [s] the time of tick 0
  };

  /// Declares the discrete state (number of the last tick; y since then; s), the output "out" and
  /// the time event "tick". The inputs and parameters are declared before. ModelError for a period
  /// that is not positive. With an inherited period the ticks are the triggers of a
  /// TriggeredSubsystem, which holds the output.
  void declare_law(const Law& law);

 private:
  void declare_inherited_law(const Law& law);
};

}  // namespace saltus::detail
