// y = 0 for |u| < half_range, elementwise; elsewhere y = u, or y = u -+ half_range with `shifted`.
// in: any width. out: the width of u and half_range. Parameter "half_range". If y reaches a
// derivative, both edges are located and the side is held between instants. Without `shifted` y
// jumps at the edges, as Collimator's block does; with it y is continuous, as Simulink's.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct DeadZoneOptions {
  Value half_range = 1.0;  ///< >= 0, in the unit of u
  bool shifted = false;    ///< subtracts the edge outside the zone, so that y is continuous
};

class DeadZone final : public LeafSystem {
 public:
  using Options = DeadZoneOptions;

  explicit DeadZone(std::string name, const Options& options = {});
};

}  // namespace saltus
