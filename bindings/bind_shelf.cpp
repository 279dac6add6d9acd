// The shelf: scenes made by C++, and their systems.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "names.hpp"
#include "saltus/models/shelf.hpp"
#include "shared_system.hpp"

namespace saltus::python {

namespace {

using Recorded = std::vector<std::tuple<std::string, SystemHandle, int>>;

/// The name and title of every scene, in the order of the shelf.
std::vector<std::pair<std::string, std::string>> shelf() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& entry : models::shelf()) all.emplace_back(entry.name, entry.title);
  return all;
}

/// Ports refer to blocks inside the scene's system, so they keep it alive.
Recorded recorded_signals(const Scene& scene) {
  Recorded all;
  for (const auto& [name, port] : scene.options.recorded_signals)
    all.emplace_back(name, SystemHandle{{scene.system, port.system}}, port.index);
  return all;
}

std::vector<std::string> invariant_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Invariant& invariant : scene.invariants) names.push_back(invariant.name);
  return names;
}

}  // namespace

void bind_shelf(py::module_& module) {
  py::class_<SystemHandle>(module, "SystemHandle")
      .def("__eq__", [](const SystemHandle& a, const SystemHandle& b) {
        return a.system.get() == b.system.get();
      });

  py::class_<SharedSystem, System>(module, "SharedSystem")
      .def(py::init<const SystemHandle&>())
      .def_property_readonly(
          "system_id", [](const SharedSystem& shared) { return shared.shared().system_id().value; })
      .def_property_readonly("block_names", &SharedSystem::block_names)
      .def("block", &SharedSystem::block);

  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene")
      .def_readonly("context", &Scene::context)
      .def_readonly("options", &Scene::options)
      .def_readonly("methods", &Scene::methods)
      .def_readonly("growth", &Scene::growth)
      .def_property_readonly("system", [](const Scene& s) { return SystemHandle{s.system}; })
      .def_property_readonly("t_span",
                             [](const Scene& s) { return std::pair(s.span.begin, s.span.end); })
      .def_property_readonly("provenance", [](const Scene& s) { return s.exact.provenance; })
      .def_property_readonly("recorded_signals", &recorded_signals)
      .def_property_readonly("invariants", &invariant_names);

  module.def("shelf", &shelf);
  module.def("scene", [](const std::string& name, const models::SceneParameters& with) {
    return std::make_shared<Scene>(models::scene(name, with));
  });
  module.def("scene_parameters", [](const std::string& name) {
    for (const auto& entry : models::shelf())
      if (entry.name == name) return entry.parameters;
    return models::SceneParameters{};
  });
}

}  // namespace saltus::python
