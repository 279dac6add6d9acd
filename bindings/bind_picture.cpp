// Pictures of a system as text: DOT and Mermaid.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "saltus/plan/picture.hpp"

namespace saltus::python {

namespace {

using Recorded = std::optional<std::vector<std::tuple<std::string, const System*, int>>>;

PictureOptions options_of(const Recorded& recorded, std::optional<int> max_depth) {
  PictureOptions options;
  if (max_depth) options.max_depth = *max_depth;
  if (!recorded) return options;
  options.recorded_signals.emplace();
  for (const auto& [name, system, index] : *recorded)
    options.recorded_signals->push_back({name, {system, index}});
  return options;
}

}  // namespace

void bind_picture(py::module_& module) {
  module.def("to_dot",
             [](const System& system, const Recorded& recorded, std::optional<int> max_depth) {
               return to_dot(system, options_of(recorded, max_depth));
             });
  module.def("to_mermaid",
             [](const System& system, const Recorded& recorded, std::optional<int> max_depth) {
               return to_mermaid(system, options_of(recorded, max_depth));
             });
  module.def("modes_to_mermaid", &modes_to_mermaid);
}

}  // namespace saltus::python
