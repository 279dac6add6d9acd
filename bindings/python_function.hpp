// One callback of a Python block: what it is for, and the objects that its calls use again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiled_function.hpp"
#include "state.hpp"

namespace saltus::python {

/// Which inputs a function reads, and so gets; all if not said.
using InputList = std::optional<std::vector<int>>;

/// How a function is called.
enum class Convention {
  state,   ///< f(time, state, *inputs, **parameters)
  inputs,  ///< f((u_0, u_1, ...))
  input    ///< f(u_0)
};

/// What a function computes.
enum class Role { ode, jacobian, sparse_jacobian, output, guard, reset_map, update };

/// The Python objects of one call. They are used for the next one too, except those that the
/// function has kept: it holds a reference to them.
struct Frame {
  py::object time, state, inputs_tuple, out;
  std::vector<py::object> inputs, parameters;
  Eigen::VectorXd parameter_values;
  std::vector<PyObject*> arguments;  // the first is room that vectorcall may use
  std::size_t positional = 0;
  py::object keywords;  // names of the arguments after the positional ones
};

struct Function {
  py::object callable;  // of a method of the block itself the plain function, so that it refers
                        // to no block
  bool method = false;  // the block goes before the other arguments
  Convention convention = Convention::state;
  InputList inputs = {};
  std::string what = {};  // names it in messages
  Role role = Role::output;
  int index = 0;                  // of the output, zero crossing or time event it belongs to
  bool in_place = false;          // it fills an array called `out`
  CompiledPointer compiled = {};  // in place of Python
  void* user_data = nullptr;      // of the compiled one
  std::unique_ptr<Frame> spare = {};
};

/// How many there are, as the position of the next.
template <class List>
int count_of(const List& list) {
  return static_cast<int>(list.size());
}

/// The bits of an entry of `out` that nobody has written: a NaN that no arithmetic makes.
inline constexpr std::uint64_t unwritten = 0x7ff85a175a175a17;

}  // namespace saltus::python
