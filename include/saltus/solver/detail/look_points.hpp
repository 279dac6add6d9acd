// LookPoints: where a search has to look at the guards inside a step.
#pragma once

#include <vector>

#include "saltus/solver/detail/guard_set.hpp"

namespace saltus {

/// A method that knows more of its guards than their values, for example their series.
class LookPoints {
 public:
  virtual ~LookPoints() = default;
  /// Offsets inside (from, to), in ascending order, such that none of the located guards crosses
  /// more than once between two of them, before the first, or after the last. Null if the method
  /// does not know: the search then looks at evenly spaced points, and where three looks suggest a
  /// dip.
  virtual const std::vector<double>* between(const LocatedGuards& located, double from,
                                             double to) = 0;
};

}  // namespace saltus
