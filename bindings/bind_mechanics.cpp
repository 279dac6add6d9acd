// Parts of machines: play and friction.
#include "blocks.hpp"
#include "saltus/library/backlash.hpp"
#include "saltus/library/mass_with_friction.hpp"
#include "saltus/library/rigid_body.hpp"

namespace saltus::python {

void bind_mechanics(py::module_& module) {
  py::class_<Backlash, System>(module, "Backlash")
      .def(py::init([](const std::string& name, double width, double initial_output) {
        return std::make_unique<Backlash>(name, width, BacklashOptions{initial_output});
      }));
  py::class_<MassWithFriction, System>(module, "MassWithFriction")
      .def(py::init([](const std::string& name, double mass, double coulomb,
                       std::optional<double> static_friction, double viscous,
                       double initial_position, double initial_velocity) {
        return std::make_unique<MassWithFriction>(
            name, MassWithFrictionOptions{mass, coulomb, static_friction, viscous, initial_position,
                                          initial_velocity});
      }));
  py::class_<RigidBody, System>(module, "RigidBody")
      .def(py::init([](const std::string& name, double mass, const py::object& inertia,
                       const py::object& gravity, const py::object& position,
                       const py::object& velocity, const py::object& orientation,
                       const py::object& rates) {
        const Arguments of(name);
        const auto vector = [&](const py::object& numbers, std::string_view what, Index n) {
          const Eigen::VectorXd found = of.vector(numbers, what);
          detail::insist(found.size() == n, name, what, " has ", found.size(), " values; expected ",
                         n);
          return found;
        };
        const Eigen::MatrixXd j = of.matrix(inertia, "inertia");
        detail::insist(j.rows() == 3 && j.cols() == 3, name, "inertia is ", j.rows(), " x ",
                       j.cols(), "; expected 3 x 3");
        return std::make_unique<RigidBody>(
            name, RigidBodyOptions{mass, j, vector(gravity, "gravity", 3),
                                   vector(position, "initial_position", 3),
                                   vector(velocity, "initial_velocity", 3),
                                   vector(orientation, "initial_orientation", 4),
                                   vector(rates, "initial_rates", 3)});
      }));
}

}  // namespace saltus::python
