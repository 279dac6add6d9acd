// The common part of elementwise blocks: a scalar counts as a signal of equal entries, and vectors
// and matrices must have one shape.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// Entry i of a vector, or the only entry of a scalar.
inline double entry(const VectorView& values, Index i) {
  return values[values.size() == 1 ? 0 : i];
}

/// The shape that fits all inputs. Throws ShapeMismatchError if signals of different shapes meet.
Shape stretched(const std::string& block, std::span<const Shape> shapes);

/// Refuses a value of a block, called `what`, whose shape differs from that of `state`, and that is
/// not one number.
void require_shape(const std::string& block, std::string_view what, const Shape& found,
                   std::string_view state, const Shape& expected);

/// The rule for an output that combines the block's inputs with `parameters`, entry by entry.
ShapeRule stretch(std::string block, std::vector<Shape> parameters = {});

/// The width of a relation between inputs and parameters of these shapes. The inputs decide it,
/// unless a parameter is wider than one.
std::optional<Index> relation_width(const std::string& block, const std::vector<Shape>& parameters);

}  // namespace saltus::detail
