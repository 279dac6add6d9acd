#include "state.hpp"

#include "context_docs.hpp"

#include <array>
#include <type_traits>

namespace saltus::python {

namespace {

/// A copy of `values` with the dimensions of `like`.
py::array replaced(py::handle values, const py::array& like, const std::string& what) {
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

void add_getters(PyHeapTypeObject* heap_type) {
  static std::array<PyGetSetDef, 6> getters{{
      {"continuous_state", &get<&State::x>, nullptr, "Read-only array of the declared shape.",
       nullptr},
      {"discrete_state", &get<&State::z>, nullptr, "Read-only array of the declared shape.",
       nullptr},
      {"relations", &get<&State::relations>, nullptr,
       "The truth of each relation of the block: a bool, or a read-only array.", nullptr},
      {"mode", &get<&State::mode>, nullptr, "The mode of the block.", nullptr},
      {"entry", &get<&State::entry>, nullptr,
       "In a reset map: which guard of a zero crossing of several fired; else 0.", nullptr},
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
      .def("__repr__", [](const State& s) {
        return py::str("State(continuous_state={}, discrete_state={}, mode={})")
            .format(s.x, s.z, s.mode);
      });
}

}  // namespace saltus::python
