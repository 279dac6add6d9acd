// mass dv/dt = u - viscous v - coulomb sign(v), dx/dt = v; a body at v = 0 sticks while |u| <=
// static.
// in: the force u, scalar. x, v: outputs, views of the state. Parameters "mass" [kg], "coulomb"
// [N], "static" [N] >= coulomb, "viscous" [N s/m]. While the body sticks v is exactly 0, and x does
// not creep. When v reaches 0 the body stops, and moves on only if the force exceeds the static
// friction. Both are located as events.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct MassWithFrictionOptions {
  double mass = 1.0;                           ///< [kg] > 0
  double coulomb = 1.0;                        ///< [N] >= 0, while it slides
  std::optional<double> static_friction = {};  ///< [N] >= coulomb, while it sticks; else coulomb
  double viscous = 0.0;                        ///< [N s/m] >= 0
  double initial_position = 0.0;               ///< [m]
  double initial_velocity = 0.0;               ///< [m/s]
};

class MassWithFriction final : public LeafSystem {
 public:
  using Options = MassWithFrictionOptions;

  explicit MassWithFriction(std::string name, const Options& options = {});

 private:
  void declare_checks();
  void declare_motion(const Options& options);
  void declare_slip(const char* event, double side);
  void declare_stick();

  ParameterIndex mass_, coulomb_, static_, viscous_;
};

}  // namespace saltus
