// A rigid body with six degrees of freedom, by Euler's equations and a quaternion.
#include "saltus/library/rigid_body.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

namespace {

void require_sound(const std::string& block, const RigidBodyOptions& o) {
  detail::insist(o.mass > 0.0, block, "mass = ", o.mass, " kg; expected a number > 0");
  const bool positive = o.inertia.allFinite() && o.inertia == o.inertia.transpose() &&
                        Eigen::LLT<Eigen::Matrix3d>(o.inertia).info() == Eigen::Success;
  detail::insist(positive, block, "inertia is not a symmetric, positive definite 3 x 3 matrix");
  const double norm = o.initial_orientation.norm();
  detail::insist(norm > 0.0, block, "initial_orientation has the norm ", norm,
                 "; expected a quaternion (w, x, y, z) that is not 0");
}

}  // namespace

RigidBody::RigidBody(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  require_sound(this->name(), options);
  const ParameterIndex mass = declare_dynamic_parameter("mass", options.mass);
  const ParameterIndex gravity =
      declare_dynamic_parameter("gravity", Eigen::VectorXd(options.gravity));
  declare_input_port({.name = "force", .shape = Shape::of(3)});
  declare_input_port({.name = "torque", .shape = Shape::of(3)});
  Eigen::VectorXd initial(13);
  initial << options.initial_position, options.initial_velocity,
      options.initial_orientation.normalized(), options.initial_rates;
  const Eigen::Matrix3d inertia = options.inertia, inverse = inertia.inverse();
  const auto motion = [=](const At& at, VectorRef xdot) {
    const Eigen::Vector3d rates = at.x.tail<3>(), torque = at.u[1];
    const double w = at.x[6];
    const Eigen::Vector3d axis = at.x.segment<3>(7);
    xdot.head<3>() = at.x.segment<3>(3);
    xdot.segment<3>(3) = at.u[0] / at.p[mass] + at.parameter(gravity);
    const double back = 0.5 * (1.0 - at.x.segment<4>(6).squaredNorm());  // 0 for a unit quaternion
    xdot[6] = -0.5 * axis.dot(rates) + back * w;
    xdot.segment<3>(7) = 0.5 * (w * rates + axis.cross(rates)) + back * axis;
    xdot.tail<3>() = inverse * (torque - rates.cross(inertia * rates));
  };
  declare_continuous_state({.initial = initial,
                            .ode = motion,
                            .reads = Reads::continuous_state | Reads::inputs});
  const auto show = [this](const char* output, Index first, Index size) {
    declare_output_port({.name = output,
                         .shape = Shape::of(size),
                         .reads = Reads::continuous_state,
                         .view = Place{Space::x, first, size}});
  };
  show("position", 0, 3);
  show("velocity", 3, 3);
  show("orientation", 6, 4);
  show("rates", 10, 3);
}

}  // namespace saltus
