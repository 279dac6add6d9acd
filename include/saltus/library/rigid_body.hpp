// A rigid body with six degrees of freedom: dp/dt = v, m dv/dt = F + m g, dq/dt = q (0, w) / 2
// + (1 - q.q) q / 2, J dw/dt = T - w x J w. The second term of dq/dt is 0 for a unit quaternion; it
// draws the norm back to 1 at the rate of 1 /s, so that errors of the solver do not add up in it.
// force: F [N] in the axes of the world, 3. torque: T [N m] in the axes of the body, 3.
// position p [m] and velocity v [m/s] in the axes of the world: 3. orientation: the quaternion q
// (w, x, y, z) that turns a vector of the body into one of the world: 4. rates: w [rad/s] in the
// axes of the body: 3. All outputs are views of the state. Parameters "mass" [kg], "gravity"
// [m/s^2]. Euler's equations: Goldstein, Classical Mechanics, section 5.5.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

struct RigidBodyOptions {
  double mass = 1.0;                                           ///< [kg] > 0
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();       ///< J [kg m^2], symmetric, positive
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();           ///< g [m/s^2]
  Eigen::Vector3d initial_position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d initial_velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector4d initial_orientation{1.0, 0.0, 0.0, 0.0};     ///< a quaternion, made unit
  Eigen::Vector3d initial_rates = Eigen::Vector3d::Zero();     ///< [rad/s]
};

class RigidBody final : public LeafSystem {
 public:
  using Options = RigidBodyOptions;

  explicit RigidBody(std::string name, const Options& options = {});
};

}  // namespace saltus
