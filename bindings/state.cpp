#include "state.hpp"

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

}  // namespace saltus::python
