// The state argument of a Python callback: `state.continuous_state`,
// `state.with_continuous_state(x)`.
#pragma once

#include <string>

#include "numbers.hpp"

namespace saltus::python {

/// The state of one block at one time. To Python it is a value: its arrays own their memory and are
/// read-only. Each `with_*` returns a new state that remembers the written parts.
struct State {
  State(std::string block_name, const Dimensions& x_dimensions, const Dimensions& z_dimensions)
      : block(std::move(block_name)),
        x(read_only_array(x_dimensions, nullptr)),
        z(read_only_array(z_dimensions, nullptr)) {}

  State with_continuous_state(py::handle values) const;
  State with_discrete_state(py::handle values) const;
  State with_mode(int other) const;

  /// Passes the values that a reset map or update wrote to the engine.
  void write_to(Next& next) const;

  std::string block;
  py::array x, z;
  py::tuple relations;  ///< the truth of each relation: a bool, or an array of 0 and 1
  int mode = 0;
  Index entry = 0;
  bool wrote_x = false, wrote_z = false, wrote_mode = false;
};

/// The state inside a Python object, at no cost.
inline State& state_in(py::handle object) {
  return *static_cast<State*>(
      reinterpret_cast<py::detail::instance*>(object.ptr())->simple_value_holder[0]);
}

}  // namespace saltus::python
