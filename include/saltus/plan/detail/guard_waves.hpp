// GuardWaves: the sines, remainders and roundings of the time in the expressions of guards.
#pragma once

#include <memory>
#include <optional>

#include "saltus/plan/plan.hpp"
#include "saltus/tape/ranges.hpp"

namespace saltus {

/// The turning operations of the time behind a plan's guards, over the variables of a FlowGraph. A guard
/// that is called, or reads a called signal, has none.
struct GuardWaves {
  /// One operation in the expression of one guard.
  struct Wave {
    std::size_t slot = 0;  ///< of the guard
    int guard = 0;         ///< the place of its bounds among those of `guards`
    int argument = 0;      ///< the place of the bounds of the argument among those of `arguments`
    double period = 1.0;   ///< of the operation, in the unit of the argument
  };
  List<Wave> waves = {};
  std::optional<tape::Ranges> arguments = {}, guards = {};  ///< none if there are no waves
};

/// The waves that the plan keeps; the first call finds them.
std::shared_ptr<const GuardWaves> guard_waves(const Plan& plan);

}  // namespace saltus
