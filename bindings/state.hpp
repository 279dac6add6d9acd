// What a Python callback sees of its block: `state.continuous_state`,
// `state.with_continuous_state(x)`.
#pragma once

#include <string>

#include "numbers.hpp"

namespace saltus::python {

/// The state of one block at one time. To Python it is a value: its arrays own their memory and
/// cannot be written to; each `with_*` returns a new one that knows what was written.
struct State {
  State(std::string block_name, const Dimensions& x_dimensions, const Dimensions& z_dimensions)
      : block(std::move(block_name)),
        x(read_only_array(x_dimensions, nullptr)),
        z(read_only_array(z_dimensions, nullptr)) {}

  State with_continuous_state(py::handle values) const;
  State with_discrete_state(py::handle values) const;
  State with_mode(int other) const;

  /// Says to the engine what a reset map or update wrote.
  void write_to(Next& next) const;

  std::string block;
  py::array x, z;
  int mode = 0;
  Index entry = 0;
  bool wrote_x = false, wrote_z = false, wrote_mode = false;
};

/// The state in a Python object that is one, at no cost.
inline State& state_in(py::handle object) {
  return *static_cast<State*>(
      reinterpret_cast<py::detail::instance*>(object.ptr())->simple_value_holder[0]);
}

}  // namespace saltus::python
