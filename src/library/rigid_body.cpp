// A rigid body with six degrees of freedom, by Euler's equations and a quaternion.
#include "saltus/library/rigid_body.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <type_traits>

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

namespace {

void require_sound(const std::string& block, const RigidBodyOptions& o) {
  const bool positive = o.inertia.allFinite() && o.inertia == o.inertia.transpose() &&
                        Eigen::LLT<Eigen::Matrix3d>(o.inertia).info() == Eigen::Success;
  detail::insist(positive, block, "inertia is not a symmetric, positive definite 3 x 3 matrix");
  const double norm = o.initial_orientation.norm();
  detail::insist(norm > 0.0, block, "initial_orientation has the norm ", norm,
                 "; expected a quaternion (w, x, y, z) that is not 0");
}

/// The derivative of entry i of (p, v, q, w): as a formula it has an exact Jacobian and a series.
struct Motion {
  ParameterIndex mass, gravity;
  Eigen::Matrix3d inertia, inverse;

  template <class Values>
  auto operator()(const Values& at, Index i) const {
    using Number = std::decay_t<decltype(at.x(0) + at.u(0, 0))>;
    if (i < 3) return Number(at.x(3 + i));
    if (i < 6) return Number(at.u(0, i - 3) / at.p(mass, 0) + at.p(gravity, i - 3));
    return i < 10 ? Number(turn(at, i - 6)) : Number(spin(at, i - 10));
  }

  /// Entry i of q (0, w) / 2 + (1 - q.q) q / 2, with the vector part behind entry 0.
  template <class Values>
  auto turn(const Values& at, Index i) const {
    const auto q = [&](Index k) { return at.x(6 + k); };
    const auto w = [&](Index k) { return at.x(10 + k % 3); };
    const auto norm = q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3);
    const auto back = 0.5 * (1.0 - norm) * q(i);
    using Number = std::decay_t<decltype(back)>;
    if (i == 0) return Number(-0.5 * (q(1) * w(0) + q(2) * w(1) + q(3) * w(2)) + back);
    const Index j = i % 3, k = (i + 1) % 3;  // the axes behind i - 1
    return Number(0.5 * (q(0) * w(i - 1) + q(1 + j) * w(k) - q(1 + k) * w(j)) + back);
  }

  /// Entry i of J^-1 (T - w x J w).
  template <class Values>
  auto spin(const Values& at, Index i) const {
    const auto w = [&](Index k) { return at.x(10 + k); };
    const auto momentum = [&](Index k) {
      return inertia(k, 0) * w(0) + inertia(k, 1) * w(1) + inertia(k, 2) * w(2);
    };
    const auto torque = [&](Index k) {
      const Index a = (k + 1) % 3, b = (k + 2) % 3;
      return at.u(1, k) - (w(a) * momentum(b) - w(b) * momentum(a));
    };
    return inverse(i, 0) * torque(0) + inverse(i, 1) * torque(1) + inverse(i, 2) * torque(2);
  }
};

}  // namespace

RigidBody::RigidBody(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  require_sound(this->name(), options);
  const ParameterIndex mass = declare_dynamic_parameter("mass", options.mass);
  declare_parameter_check(detail::positive(mass, "mass", " kg"));
  const ParameterIndex gravity =
      declare_dynamic_parameter("gravity", Eigen::VectorXd(options.gravity));
  declare_input_port({.name = "force", .shape = Shape::of(3)});
  declare_input_port({.name = "torque", .shape = Shape::of(3)});
  Eigen::VectorXd initial(13);
  initial << options.initial_position, options.initial_velocity,
      options.initial_orientation.normalized(), options.initial_rates;
  declare_continuous_state(
      {.initial = initial,
       .reads = Reads::continuous_state | Reads::inputs,
       .formula = Motion{mass, gravity, options.inertia, options.inertia.inverse()}});
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
