// The common part of elementwise blocks: a scalar counts as a vector of equal entries, and vectors
// must have one width.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "saltus/library/arguments.hpp"

namespace saltus::detail {

/// Entry i of a vector, or the only entry of a scalar.
inline double entry(const VectorView& values, Index i) {
  return values[values.size() == 1 ? 0 : i];
}

/// The shape that fits all of them; a ModelError if vectors of different widths meet.
inline Shape stretched(const std::string& block, std::span<const Shape> shapes) {
  const Shape result = elementwise(shapes);
  const bool fit = std::ranges::all_of(shapes, [&](const Shape& shape) {
    return (shape.size == 1 || shape.size == result.size) && shape.size > 0;
  });
  if (fit) return result;
  std::string widths;
  for (const Shape& shape : shapes) widths += text(widths.empty() ? "" : ", ", shape.size);
  insist(fit, block, "expected scalars and vectors of one width, found the widths ", widths,
         "; bring them to one width, for example with a Multiplexer");
  return result;
}

/// The rule for an output that combines the block's inputs with `parameters`, entry by entry.
inline ShapeRule stretch(std::string block, std::vector<Shape> parameters = {}) {
  return [block = std::move(block),
          parameters = std::move(parameters)](std::span<const Shape> inputs) {
    std::vector<Shape> all = parameters;
    all.insert(all.end(), inputs.begin(), inputs.end());
    return stretched(block, all);
  };
}

/// The width of a relation between inputs and parameters of these shapes. The inputs decide it,
/// unless a parameter is wider than one.
inline std::optional<Index> relation_width(const std::string& block,
                                           const std::vector<Shape>& parameters) {
  const Shape shape = stretched(block, parameters);
  return shape.size > 1 ? std::optional(shape.size) : std::nullopt;
}

/// Refuses a lower limit above the upper one.
inline void require_ordered(const std::string& block, const Value& lower, const Value& upper) {
  const std::vector<Shape> shapes{lower.shape(), upper.shape()};
  for (Index i = 0; i < stretched(block, shapes).size; ++i) {
    const double low = lower.values[lower.values.size() == 1 ? 0 : i];
    const double high = upper.values[upper.values.size() == 1 ? 0 : i];
    insist(low <= high, block, "lower_limit ", low, " is above upper_limit ", high,
           "; expected lower_limit <= upper_limit");
  }
}

}  // namespace saltus::detail
