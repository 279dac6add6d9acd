// Contexts as plain data: for JSON, in the format of saltus/model/context_json.hpp, and for pickle.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "context_docs.hpp"
#include "numbers.hpp"
#include "saltus/model/detail/context_data.hpp"
#include "saltus/model/detail/sound.hpp"
#include "saltus/model/system.hpp"

namespace saltus::python {

namespace {

using py::literals::operator""_a;

/// Python's dicts and lists; see saltus/model/detail/context_data.hpp.
struct PythonTree {
  using Value = py::object;

  static Value record() { return py::dict(); }
  static Value list() { return py::list(); }
  static Value row(const auto&... values) { return py::make_tuple(values...); }

  static void set(Value& record, const char* key, const auto& value) { record[key] = value; }
  static void append(Value& list, const Value& value) {
    py::reinterpret_borrow<py::list>(list).append(value);
  }

  template <class T>
  static T get(const Value& record, const char* key) {
    return record.cast<py::dict>()[key].template cast<T>();
  }
  template <class T>
  static T entry(const Value& row, std::size_t index) {
    return row.cast<py::sequence>()[index].template cast<T>();
  }
  static std::vector<Value> items(const Value& record, const char* key) {
    return get<std::vector<Value>>(record, key);
  }
  static bool has(const Value& record, const char* key) {
    return record.cast<py::dict>().contains(key);
  }

  static bool is(const Value& value, const char* text) { return value.cast<std::string>() == text; }
  static std::string shown(const Value& value) { return py::repr(value); }
};

py::object data_of(const Context& context) { return detail::data_of<PythonTree>(context); }

/// Calls `read`. Data in another format has a missing key, a list that is too short or a wrong
/// type: a ModelError.
template <class Read>
Context refusing_others(Read read) {
  try {
    return read();
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;
    const std::string what = error.what();
    throw ModelError(text("a context is damaged: ", what.substr(0, what.find('\n'))));
  } catch (const py::builtin_exception& error) {
    throw ModelError(text("a context holds something else than expected: ", error.what()));
  }
}

py::tuple layout_data(const Layout& layout) {
  py::list leaves, systems;
  for (const Layout::Leaf& leaf : layout.leaves) {
    py::list parameters;
    for (const auto& p : leaf.parameters)
      parameters.append(py::make_tuple(p.name, p.offset, p.size, static_cast<int>(p.role)));
    leaves.append(py::make_tuple(leaf.path, leaf.x, leaf.nx, leaf.z, leaf.nz, leaf.p, leaf.np,
                                 parameters, leaf.states, leaf.of_diagram));
  }
  for (const Layout::Range& r : layout.systems)
    systems.append(py::make_tuple(r.id.value, r.path, r.first, r.last));
  return py::make_tuple(leaves, systems);
}

/// Data of earlier versions have no roles.
Layout::Role role_of(const py::tuple& parameter) {
  const int role = parameter.size() > 3 ? parameter[3].cast<int>() : 0;
  if (role < 0 || role > static_cast<int>(Layout::Role::computed))
    throw ModelError(text("a context is damaged: a parameter has the role ", role));
  return static_cast<Layout::Role>(role);
}

std::shared_ptr<const Layout> layout_from(const py::tuple& data) {
  auto layout = std::make_shared<Layout>();
  for (const py::handle item : data[0]) {
    const auto l = item.cast<py::tuple>();
    Layout::Leaf leaf{.path = l[0].cast<std::string>(),
                      .x = l[1].cast<Index>(),
                      .nx = l[2].cast<Index>(),
                      .z = l[3].cast<Index>(),
                      .nz = l[4].cast<Index>(),
                      .p = l[5].cast<Index>(),
                      .np = l[6].cast<Index>(),
                      .parameters = {}};
    for (const py::handle p : l[7]) {
      const auto parameter = p.cast<py::tuple>();
      leaf.parameters.push_back({parameter[0].cast<std::string>(), parameter[1].cast<Index>(),
                                 parameter[2].cast<Index>(), role_of(parameter)});
    }
    if (l.size() > 8) leaf.states = l[8].cast<std::vector<std::string>>();
    if (l.size() > 9) leaf.of_diagram = l[9].cast<bool>();
    layout->leaves.push_back(std::move(leaf));
  }
  for (const py::handle item : data[1]) {
    const auto r = item.cast<py::tuple>();
    layout->systems.push_back({SystemId{r[0].cast<int>()}, r[1].cast<std::string>(),
                               r[2].cast<std::size_t>(), r[3].cast<std::size_t>()});
  }
  detail::require_sound(*layout);
  return layout;
}

/// The context that was pickled as (layout, data).
Context from_state(const py::object& state) {
  const auto parts = state.cast<py::tuple>();
  if (parts.size() != 2)
    throw ModelError(text("a context is damaged: it has ", parts.size(), " parts, expected 2"));
  const auto layout = layout_from(parts[0].cast<py::tuple>());
  const ContextValues values = detail::values_from<PythonTree>(*layout, parts[1].cast<py::dict>());
  return Context::zero(layout).with_values(values);  // the sizes are those of the values
}

}  // namespace

void bind_context_saving(py::class_<Context>& context) {
  context.def(
             "to_dict", [](const Context& c) { return data_of(c); }, docs::to_dict)
      .def(
          "to_json",
          [](const Context& c) {
            return py::module_::import("json").attr("dumps")(data_of(c), "indent"_a = 1);
          },
          docs::to_json)
      .def(py::pickle(
          [](const Context& c) { return py::make_tuple(layout_data(c.layout()), data_of(c)); },
          [](const py::object& state) {
            return refusing_others([&] { return from_state(state); });
          }));
}

void bind_context_reading(py::module_& module) {
  module.def(
      "context_from_dict",
      [](const System& system, const py::dict& data) {
        const Context blank = system.create_context();
        return refusing_others([&] {
          return blank.with_values(detail::values_from<PythonTree>(blank.layout(), data));
        });
      },
      py::arg("system"), py::arg("data"),
      "The context of `system` that Context.to_dict gave. Raises ModelError for other data.");
}

}  // namespace saltus::python
