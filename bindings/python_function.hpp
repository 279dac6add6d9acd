// One callback of a Python block: its purpose, and the objects that its calls reuse.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiled_function.hpp"
#include "state.hpp"

namespace saltus::python {

/// The inputs that a function reads, and therefore gets; if not given, all.
using InputList = std::optional<std::vector<int>>;

/// The arguments with which a function is called.
enum class Convention {
  state,   ///< f(time, state, *inputs, **parameters)
  inputs,  ///< f((u_0, u_1, ...))
  input    ///< f(u_0)
};

/// The purpose of a function.
enum class Role {
  ode,
  jacobian,
  sparse_jacobian,
  output,
  guard,
  reset_map,
  update,
  relation,
  edge_reset,
  delay,        // of a queued zero crossing
  priority,     // likewise
  derivatives,  // of another function
  event_input,  // its last input is the weight of the wire
};

/// Whether the weight of an event wire comes after the inputs.
inline bool gets_weight(Role role) { return role == Role::event_input; }

/// Whether the sign of its values says on which side of an event the block is.
inline bool is_guard(Role role) { return role == Role::guard || role == Role::relation; }

/// The Python objects of one call. The next call reuses them, except those that the function has
/// kept by a reference.
struct Frame {
  py::object time, state, inputs_tuple, out;
  std::vector<py::object> inputs, parameters;
  Eigen::VectorXd parameter_values;
  std::vector<PyObject*> arguments;  // the first is room that vectorcall may use
  std::size_t positional = 0;
  py::object keywords;  // names of the arguments after the positional ones
};

struct Function {
  // The callable; for a method of the block itself its plain function, which refers to no block.
  py::object callable = {};
  bool method = false;  // the block is passed before the other arguments
  Convention convention = Convention::state;
  InputList inputs = {};
  std::string what = {};  // its name in messages
  Role role = Role::output;
  bool formula = false;           // a plan may compute it together with its neighbours
  int index = 0;                  // of its declaration, among those of its kind
  Index columns = 0;              // of its result, if that is known to be a matrix
  bool in_place = false;          // whether it fills an array called `out`
  CompiledPointer compiled = {};  // in place of Python
  void* user_data = nullptr;      // of the compiled function
  std::unique_ptr<Frame> spare = {};
};

/// The number of functions of this kind, which is the position of the next.
template <class List>
int count_of(const List& list) {
  return static_cast<int>(list.size());
}

/// The bits of an entry of `out` that the function has not written: a NaN that no arithmetic
/// produces.
inline constexpr std::uint64_t unwritten = 0x7ff85a175a175a17;

}  // namespace saltus::python
