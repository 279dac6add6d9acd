// Numbers from Python to C++ and back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include "bindings.hpp"
#include "saltus/library/arguments.hpp"

namespace saltus::python {

using Array = py::array_t<double, py::array::c_style>;
using Dimensions = std::vector<py::ssize_t>;  ///< of an array; {} is a single number

/// Numbers as an array of doubles; a ModelError that begins with `what` for anything else, None
/// among it.
Array to_array(py::handle numbers, const std::string& what);
/// The same as one vector, whatever the dimensions.
Eigen::VectorXd to_vector(py::handle numbers, const std::string& what);
/// A number makes a scalar signal, a vector a vector signal.
Value to_value(py::handle numbers, const std::string& what);
/// As to_value; empty for None.
std::optional<Value> to_optional_value(py::handle numbers, const std::string& what);

/// Numbers as most functions give them: a float, an array of doubles, a list or tuple of floats.
/// False for anything else, and for another number of them.
bool read_plain_numbers(py::handle result, VectorRef out);
/// Any numbers; a ModelError if they are none, or not as many.
void read_any_numbers(py::handle result, VectorRef out, const std::string& what);

/// What a Python function gave back, written to `out`; a ModelError that begins with what `whose`
/// says if it is not as many numbers.
template <class Whose>
void read_numbers(py::handle result, VectorRef out, const Whose& whose) {
  if (!read_plain_numbers(result, out)) read_any_numbers(result, out, whose());
}

Dimensions dimensions_of(const py::array& array);
/// A new array with memory of its own that Python code cannot write to; `values` may be null.
py::array read_only_array(const Dimensions& dimensions, const double* values);
/// Where an array keeps its numbers, writable or not.
double* numbers_of(py::handle array);
/// How many numbers an array has.
Index size_of(py::handle array);

inline Eigen::Map<const Eigen::VectorXd> as_vector(const py::array& array) {
  return {numbers_of(array), array.size()};
}

}  // namespace saltus::python
