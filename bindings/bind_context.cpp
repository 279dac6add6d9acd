// Context: a value. Its docstrings are in C++, because Python gets a Context from C++ in many
// places.
#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.hpp"
#include "context_docs.hpp"
#include "numbers.hpp"
#include "saltus/base/detail/listed.hpp"
#include "saltus/model/system.hpp"

namespace saltus::python {

namespace {

/// An array over a copy: a context is a value, and so are its arrays.
py::array shown(const Eigen::VectorXd& values) {
  return read_only_array({values.size()}, values.data());
}

SystemId id_of(py::handle system) {
  // by its attribute: the id of a shared system is the id of the system that it represents
  if (py::isinstance<System>(system)) return SystemId{system.attr("system_id").cast<int>()};
  try {
    return SystemId{system.cast<int>()};
  } catch (const py::cast_error&) {
    throw ModelError(
        text("expected a system or its system_id, found ", std::string(py::repr(system))));
  }
}

py::dict parameters(const Context& context) {
  py::dict all;
  for (const auto& leaf : context.layout().leaves) {
    for (const auto& parameter : leaf.parameters) {
      const auto values = context.parameters().segment(leaf.p + parameter.offset, parameter.size);
      const auto name = context.layout().name_of(leaf, parameter.name);
      if (parameter.size == 1)
        all[name.c_str()] = values[0];
      else
        all[name.c_str()] = shown(values);
    }
  }
  return all;
}

Context with_parameter(const Context& context, const std::string& name, py::handle value) {
  return context.with_parameter(name, to_vector(value, text("parameter '", name, "'")));
}

/// A name of another type than str is a mistake that Python's own words for it do not explain.
Context with_parameters(Context context, const py::dict& values) {
  for (const auto& [name, value] : values) {
    if (!py::isinstance<py::str>(name))
      throw py::type_error(
          text("with_parameters: expected the names of parameters, as in {'gain': 2.0}, "
               "found the key ",
               std::string(py::repr(name))));
    context = with_parameter(context, name.cast<std::string>(), value);
  }
  return context;
}

bool equal(const Context& a, const Context& b) {
  const auto paths = [](const Context& context) {
    std::vector<std::string> all;
    for (const auto& leaf : context.layout().leaves) all.push_back(leaf.path);
    return all;
  };
  const PendingExecutions none;
  const auto pending = [&](const Context& context) -> const PendingExecutions& {
    return context.pending() != nullptr ? *context.pending() : none;
  };
  return a.time() == b.time() && a.modes() == b.modes() &&
         a.continuous_state() == b.continuous_state() && a.discrete_state() == b.discrete_state() &&
         a.parameters() == b.parameters() && paths(a) == paths(b) && pending(a) == pending(b);
}

std::string repr(const Context& context) {
  std::string out = text("Context(time=", context.time());
  if (context.continuous_state().size() > 0)
    out += text(", continuous_state=", listed(context.continuous_state()));
  if (context.discrete_state().size() > 0)
    out += text(", discrete_state=", listed(context.discrete_state()));
  if (context.modes().size() == 1) out += text(", mode=", context.mode());
  const auto blocks = std::ranges::count(context.layout().leaves, false, &Layout::Leaf::of_diagram);
  return out + (blocks == 1 ? ")" : text(", ", blocks, " blocks)"));
}

/// A context is a value: the answer to an assignment is what to write.
[[noreturn]] void refuse_set(const py::object& self, const std::string& name, const py::object&) {
  const std::string method = "with_" + name;
  if (py::hasattr(self, method.c_str()))
    throw py::attribute_error(text("a context is not changed in place; write context = context.",
                                   method, name == "parameters" ? "({'k': 2.0})" : "(...)"));
  std::vector<std::string> known;
  for (const py::handle each : py::module_::import("builtins").attr("dir")(self))
    if (auto one = each.cast<std::string>(); !one.starts_with('_')) known.push_back(std::move(one));
  throw py::attribute_error(
      text("'Context' object has no attribute '", name, "'", known_names(name, known)));
}

}  // namespace

void bind_context(py::module_& module) {
  py::class_<Context> context(module, "Context", docs::context);
  context.def("__setattr__", &refuse_set, py::arg("name"), py::arg("value"));
  context.def_property_readonly("time", &Context::time, "[s]")
      .def_property_readonly(
          "continuous_state", [](const Context& c) { return shown(c.continuous_state()); },
          "All continuous states, as one read-only vector.")
      .def_property_readonly(
          "discrete_state", [](const Context& c) { return shown(c.discrete_state()); },
          "All discrete states, as one read-only vector.")
      .def_property_readonly("mode", &Context::mode, "The mode, of a context of one block.")
      .def_property_readonly("modes", &Context::modes,
                             "The mode of each block, in the order of `add`.")
      .def_property_readonly(
          "parameters", &parameters,
          "Every parameter by name, a number or a read-only vector; in a diagram by 'block.name'.")
      .def_property_readonly(
          "num_continuous_states", [](const Context& c) { return c.continuous_state().size(); },
          "How many numbers `continuous_state` has.")
      .def_property_readonly(
          "num_discrete_states", [](const Context& c) { return c.discrete_state().size(); },
          "How many numbers `discrete_state` has.")
      .def_property_readonly(
          "system_id",
          [](const Context& c) {
            return c.layout().systems.empty() ? 0 : c.layout().systems.front().id.value;
          },
          "The number of the system whose values these are; 0 for none.")
      .def(
          "has_system",
          [](const Context& c, int id) {
            return std::ranges::any_of(c.layout().systems,
                                       [id](const auto& range) { return range.id.value == id; });
          },
          py::arg("system_id"), docs::has_system)
      .def_property_readonly(
          "state", [](const py::object& self) { return self; },
          "The context itself: its states and modes are the values that a run changes.")
      .def("with_time", &Context::with_time, py::arg("time"), docs::with_time)
      .def(
          "with_continuous_state",
          [](const Context& c, py::handle x) {
            return c.with_continuous_state(to_vector(x, "continuous state"));
          },
          py::arg("continuous_state"), docs::with_continuous_state)
      .def(
          "with_discrete_state",
          [](const Context& c, py::handle z) {
            return c.with_discrete_state(to_vector(z, "discrete state"));
          },
          py::arg("discrete_state"), docs::with_discrete_state)
      .def("with_mode", &Context::with_mode, py::arg("mode"), docs::with_mode)
      .def("with_parameter", &with_parameter, py::arg("name"), py::arg("value"),
           docs::with_parameter)
      .def("with_parameters", &with_parameters, py::arg("values"), docs::with_parameters)
      .def(
          "__getitem__", [](const Context& c, py::handle system) { return c[id_of(system)]; },
          py::arg("system"), docs::subcontext)
      .def(
          "with_subcontext",
          [](const Context& c, py::handle system, const Context& part) {
            return c.with_subcontext(id_of(system), part);
          },
          py::arg("system"), py::arg("context"), docs::with_subcontext)
      .def(
          "__eq__", [](const Context& a, const Context& b) { return equal(a, b); },
          py::is_operator())
      .def("__copy__", [](const Context& c) { return c; })
      .def("__deepcopy__", [](const Context& c, const py::dict&) { return c; })
      .def("__repr__", &repr);
  bind_context_saving(context);
}

}  // namespace saltus::python
