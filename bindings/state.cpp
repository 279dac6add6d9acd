#include "state.hpp"

#include "context_docs.hpp"

#include <array>
#include <type_traits>

namespace saltus::python {

namespace {

/// A copy of `values` with the dimensions of `like`.
py::array replaced(py::handle values, const py::array& like, const std::string& what) {
  if (like.ndim() == 2)
    require_matrix(values, dimensions_of(like), text(what, ": its new value is"));
  const Array array = to_array(values, what);
  if (array.size() != like.size()) {
    throw ModelError(text(what, ": expected ", like.size(), " numbers, found ", array.size(),
                          "; set all of it at once"));
  }
  return read_only_array(dimensions_of(like), array.data());
}

}  // namespace

State State::with_continuous_state(py::handle values) const {
  State next = *this;
  next.x = replaced(values, x, text("block '", block, "': continuous state"));
  next.wrote_x = true;
  return next;
}

State State::with_discrete_state(py::handle values) const {
  State next = *this;
  next.z = replaced(values, z, text("block '", block, "': discrete state"));
  next.wrote_z = true;
  return next;
}

State State::with_mode(int other) const {
  State next = *this;
  next.mode = other;
  next.wrote_mode = true;
  return next;
}

void State::write_to(Next& next) const {
  if (wrote_x) next.set_continuous_state(as_vector(x));
  if (wrote_z) next.set_discrete_state(as_vector(z));
  if (wrote_mode) next.set_mode(mode);
}

namespace {

/// Plain getters: an ode reads its state at every call, and getters of pybind11 cost more than the
/// rest of a call.
template <auto Member>
PyObject* get(PyObject* self, void*) {
  const auto& value = state_in(self).*Member;
  if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
    return PyLong_FromLongLong(value);
  } else {
    return Py_NewRef(value.ptr());
  }
}

/// A state never changes: an assignment is refused, with the remedy.
int refuse_set(PyObject*, PyObject*, void* remedy) {
  const std::string message = text("a state cannot be changed; ", static_cast<char*>(remedy));
  PyErr_SetString(py::module_::import("saltus.errors").attr("ModelError").ptr(), message.c_str());
  return -1;
}

/// What is right for `state[0]` and `for x in state`.
[[noreturn]] void refuse_array() {
  throw py::type_error(
      "the state of a callback is no array: its numbers are state.continuous_state, "
      "state.discrete_state and state.mode, as in x, v = state.continuous_state");
}

template <auto Member>
PyGetSetDef member(const char* name, const char* doc, const char* remedy) {
  return {name, &get<Member>, &refuse_set, doc, const_cast<char*>(remedy)};
}

void add_getters(PyHeapTypeObject* heap_type) {
  static std::array<PyGetSetDef, 6> getters{{
      member<&State::x>("continuous_state", "Read-only array of the declared shape.",
                        "return state.with_continuous_state(...)"),
      member<&State::z>("discrete_state", "Read-only array of the declared shape.",
                        "return state.with_discrete_state(...)"),
      member<&State::relations>(
          "relations", "The truth of each relation of the block: a bool, or a read-only array.",
          "its relations follow from their guards"),
      member<&State::mode>("mode", "The mode of the block.", "return state.with_mode(...)"),
      member<&State::entry>(
          "entry", "In a reset map: which guard of a zero crossing of several fired; else 0.",
          "the entry is that of the guard that fired"),
      {},
  }};
  heap_type->ht_type.tp_getset = getters.data();
}

}  // namespace

void bind_callback_state(py::module_& module) {
  py::class_<State>(module, "State", py::custom_type_setup(&add_getters), docs::state)
      .def("with_continuous_state", &State::with_continuous_state, py::arg("continuous_state"),
           "Another continuous state, of the declared shape.")
      .def("with_discrete_state", &State::with_discrete_state, py::arg("discrete_state"),
           "Another discrete state, of the declared shape.")
      .def("with_mode", &State::with_mode, py::arg("mode"), "Another mode.")
      .def("__getitem__", [](const State&, const py::object&) { refuse_array(); })
      .def("__iter__", [](const State&) { refuse_array(); })
      .def("__repr__", [](const State& s) {
        return py::str("State(continuous_state={}, discrete_state={}, mode={})")
            .format(s.x, s.z, s.mode);
      });
}

}  // namespace saltus::python
