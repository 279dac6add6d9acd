// Numbers from Python to C++ and back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include "bindings.hpp"
#include "saltus/library/detail/arguments.hpp"

namespace saltus::python {

using Array = py::array_t<double, py::array::c_style>;
using Dimensions = std::vector<py::ssize_t>;  ///< of an array; {} is a single number

/// Numbers as an array of doubles; a ModelError that begins with `what` for anything else,
/// including None.
Array to_array(py::handle numbers, const std::string& what);
/// The same numbers as one vector, with any dimensions.
Eigen::VectorXd to_vector(py::handle numbers, const std::string& what);
/// A number makes a scalar signal, a vector a vector signal, an array of two dimensions a matrix.
Value to_value(py::handle numbers, const std::string& what);
/// The value of numbers; empty for None.
std::optional<Value> to_optional_value(py::handle numbers, const std::string& what);

/// Reads numbers in the form in which most functions return them: a float, an int, an array of
/// doubles, a list or tuple of floats. False for anything else, and for a wrong number of entries.
bool read_plain_numbers(py::handle result, VectorRef out);
/// Reads numbers in any form. Throws ModelError if the object is not made of numbers, or has a
/// wrong number of entries.
void read_any_numbers(py::handle result, VectorRef out, const std::string& what);

/// Reads truths, such as a bool, an array or a list of them, as the values of a guard that jumps: 1
/// for true, -1 for false. Returns false if the object is anything else, or has a wrong number of
/// entries.
bool read_truths(py::handle result, VectorRef out);

/// Whether a result is an integer or has one among its entries.
bool has_integer(py::handle result);

Dimensions dimensions_of(const py::array& array);

/// Refuses an array of two dimensions or more in place of a matrix of other rows and columns, whose
/// entries would come in another order. Lists, and the entries row by row, are counted by the one who
/// reads them.
void require_matrix(py::handle result, const Dimensions& expected, const std::string& who);
/// () of a scalar, (n,) of a vector, (rows, columns) of a matrix; after `before`.
Dimensions dimensions_of(const Shape& shape, Dimensions before = {});
/// The shape of a signal with such dimensions; ModelError if there are more than two, or one of two
/// is 0.
Shape shape_of(const Dimensions& dimensions, const std::string& what);
/// A new array with its own memory that Python code cannot write to; `values` may be null.
py::array read_only_array(const Dimensions& dimensions, const double* values);
/// The memory of an array's numbers, writable or not.
double* numbers_of(py::handle array);
/// The number of entries of an array.
Index size_of(py::handle array);

inline Eigen::Map<const Eigen::VectorXd> as_vector(const py::array& array) {
  return {numbers_of(array), array.size()};
}

}  // namespace saltus::python
