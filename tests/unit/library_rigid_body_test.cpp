// RigidBody: a symmetric top free of torque, a throw, and what is refused.
#include <cmath>

#include <Eigen/Geometry>

#include "library_runs.hpp"

using namespace saltus;
using namespace library_test;
using Catch::Matchers::WithinAbs;

namespace {

const auto pushed = [](DiagramBuilder& builder, auto& block) {
  const Value none{0.0, 0.0, 0.0}, force{2.0, 0.0, 0.0};
  builder.connect(builder.add<Constant>("force", force).output(), block.input(0));
  builder.connect(builder.add<Constant>("torque", none).output(), block.input(1));
};

RigidBody::Options top() {
  RigidBody::Options options;
  options.mass = 2.0;
  options.inertia = Eigen::Vector3d(1.0, 1.0, 2.0).asDiagonal();
  options.gravity = {0.0, 0.0, -10.0};
  options.initial_velocity = {0.0, 0.0, 20.0};
  options.initial_rates = {0.3, 0.0, 2.0};
  return options;
}

}  // namespace

/// With J = diag(1, 1, 2) and w_3 = 2: dw_1/dt = -2 w_2, dw_2/dt = 2 w_1.
TEST_CASE("a RigidBody free of torque precesses and keeps its angular momentum",
          "[library][mechanics]") {
  const BlockRun<RigidBody> scene(pushed, top());
  const Results results = scene.run(3.0);
  const Eigen::VectorXd x = results.context.continuous_state();
  const Eigen::Vector3d rates = x.tail(3);
  CHECK_THAT(rates[0], WithinAbs(0.3 * std::cos(6.0), solver_tolerance));
  CHECK_THAT(rates[1], WithinAbs(0.3 * std::sin(6.0), solver_tolerance));
  CHECK_THAT(rates[2], WithinAbs(2.0, solver_tolerance));
  const Eigen::Quaterniond turn(x[6], x[7], x[8], x[9]);
  CHECK_THAT(turn.norm(), WithinAbs(1.0, solver_tolerance));
  const Eigen::Vector3d momentum = turn * Eigen::Vector3d(rates[0], rates[1], 2.0 * rates[2]);
  CHECK((momentum - Eigen::Vector3d(0.3, 0.0, 4.0)).norm() < solver_tolerance);
}

/// The trap: the errors of all steps add up in a norm that nothing draws back. At rtol 1e-4 a
/// thousand turns leave what one step adds in a second, at most 100 tolerances; a norm of 2, as a
/// context may have it, decays by dn/dt = (n - n^3) / 2 to 1 + 1.5 / 2 exp(-t).
TEST_CASE("the quaternion of a RigidBody keeps its norm", "[library][mechanics]") {
  const BlockRun<RigidBody> scene(pushed, top());
  const Results loose = scene.run(3000.0, {.rtol = 1e-4, .atol = 1e-6});
  CHECK_THAT(loose.context.continuous_state().segment(6, 4).norm(), WithinAbs(1.0, 1e-2));
  Eigen::VectorXd x = scene.diagram.create_context().continuous_state();
  x.segment(6, 4) *= 2.0;
  const auto context = scene.diagram.create_context().with_continuous_state(x);
  const Results back = simulate(scene.diagram, context, {0.0, 30.0}, precise());
  CHECK_THAT(back.context.continuous_state().segment(6, 4).norm(), WithinAbs(1.0, 1e-8));
}

/// Without a torque w . J w is constant, and of three unequal inertias every axis moves.
TEST_CASE("a tumbling RigidBody keeps its energy", "[library][mechanics]") {
  RigidBody::Options box = top();
  box.inertia = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  box.initial_rates = {0.01, 2.0, 0.01};  // about the middle axis, which is unstable
  const BlockRun<RigidBody> scene(pushed, box);
  const Eigen::VectorXd x = scene.run(20.0).context.continuous_state();
  const Eigen::Vector3d w = x.tail(3);
  const double found = w.dot(box.inertia * w), expected = 8.0 + 4e-4;
  CHECK_THAT(found, WithinAbs(expected, 10.0 * solver_tolerance));  // dE = 2 w J dw, |w J| < 5
  CHECK(std::abs(w[0]) + std::abs(w[2]) > 0.1);                     // it has left the axis
}

/// Force 2 N on 2 kg: x = t^2 / 2; thrown up: z = 20 t - 5 t^2.
TEST_CASE("the centre of a RigidBody moves as a point", "[library][mechanics]") {
  const BlockRun<RigidBody> scene(pushed, top());
  const Eigen::VectorXd x = scene.run(3.0).context.continuous_state();
  CHECK_THAT(x[0], WithinAbs(4.5, solver_tolerance));
  CHECK_THAT(x[2], WithinAbs(15.0, 10.0 * solver_tolerance));  // |v| is 20
}

TEST_CASE("a RigidBody refuses impossible bodies", "[library][errors]") {
  RigidBody::Options flat = top(), skew = top(), light = top(), nowhere = top();
  flat.inertia(2, 2) = 0.0, skew.inertia(0, 1) = 0.5, light.mass = 0.0;
  nowhere.initial_orientation.setZero();
  for (const auto& options : {flat, skew})
    CHECK(contains(model_error([&] { RigidBody("b", options); }), "symmetric, positive definite"));
  CHECK(contains(model_error([&] { RigidBody("b", light); }), "mass = 0 kg"));
  CHECK(contains(model_error([&] { RigidBody("b", nowhere); }), "expected a quaternion"));
}
