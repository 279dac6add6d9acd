// Parts of machines: play and friction.
#include "blocks.hpp"
#include "saltus/library/backlash.hpp"
#include "saltus/library/mass_with_friction.hpp"

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
}

}  // namespace saltus::python
