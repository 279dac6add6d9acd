// Shape: a signal is a scalar, a vector or a matrix.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>

#include "saltus/base/error.hpp"
#include "saltus/base/ids.hpp"

namespace saltus {

/// Shape of a signal. A scalar remains a scalar in the results, a vector of one entry remains a
/// vector. A matrix is stored as its entries, row by row: entry (i, j) is entry i columns + j.
struct Shape {
  Index size = 1;       ///< number of entries
  bool vector = false;  ///< its entries have indices: a vector or a matrix
  Index columns = 0;    ///< of a matrix; otherwise 0
  bool operator==(const Shape&) const = default;

  static constexpr Shape scalar() { return {1, false, 0}; }
  static constexpr Shape of(Index n) { return {n, true, 0}; }
  static constexpr Shape matrix(Index rows, Index columns) {
    return {rows * columns, true, columns};
  }

  constexpr bool is_matrix() const { return columns > 0; }
  /// Rows of a matrix; a vector is a column.
  constexpr Index rows() const { return is_matrix() ? size / columns : size; }
};

/// "a scalar", "(3,)", "(2, 3)".
inline std::string to_string(const Shape& shape) {
  if (!shape.vector && shape.size == 1) return "a scalar";
  return shape.is_matrix() ? text("(", shape.rows(), ", ", shape.columns, ")")
                           : text("(", shape.size, ",)");
}

/// The same in a sentence: "a scalar", "shape (3,)".
inline std::string in_words(const Shape& shape) {
  return (shape.vector || shape.size != 1 ? "shape " : "") + to_string(shape);
}

/// "[1]" or "[0,2]": the place of an entry behind the name of a signal; empty for a scalar.
inline std::string entry_place(const Shape& shape, Index i) {
  if (!shape.vector) return {};
  return shape.is_matrix() ? text("[", i / shape.columns, ",", i % shape.columns, "]")
                           : text("[", i, "]");
}

/// Whether a port of one shape takes a signal of another. A scalar port takes any signal of one
/// entry, and a vector of one entry a scalar; a matrix fits only a port of its rows and columns.
constexpr bool takes(const Shape& port, const Shape& signal) {
  if (port.size != signal.size) return false;
  return port.vector ? port.columns == signal.columns : true;
}

/// Computes the shape of an output from the shapes of all inputs, if it is not fixed.
using ShapeRule = std::function<Shape(std::span<const Shape>)>;

/// The shape of an elementwise block, such as Gain, Adder and Abs: what has one entry is stretched
/// to the shape of the others.
inline Shape elementwise(std::span<const Shape> inputs) {
  Shape result = Shape::scalar();
  const auto rank = [](const Shape& of) { return of.is_matrix() ? 2 : of.vector ? 1 : 0; };
  for (const Shape& shape : inputs) {
    const bool wider = result.size == 1 && shape.size != 1;
    const bool deeper = result.size == 1 && shape.size == 1 && rank(shape) > rank(result);
    if (shape.vector && (wider || deeper)) result = shape;
  }
  return result;
}

}  // namespace saltus
