// The extension module saltus._core: one bind_<concept>.cpp for each concept.
#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace saltus::python;
  module.doc() = "The engine behind the package saltus; import that.";
  module.attr("__version__") = SALTUS_VERSION;
  bind_errors(module);
  bind_numbers(module);
  bind_context(module);
  bind_tape(module);
  bind_system(module);
  bind_context_reading(module);
  bind_picture(module);
  bind_leaf_system(module);
  bind_sources(module);
  bind_arithmetic(module);
  bind_logic(module);
  bind_state(module);
  bind_linear(module);
  bind_discrete(module);
  bind_results(module);
  bind_simulation(module);
  bind_evaluate(module);
  bind_linearize(module);
  bind_ensemble(module);
  bind_shelf(module);
  bind_report(module);
  bind_traces(module);
}
