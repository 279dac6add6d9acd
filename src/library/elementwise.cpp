// The checks and shape rules that elementwise blocks share.
#include "saltus/library/detail/elementwise.hpp"

#include <algorithm>
#include <utility>

namespace saltus::detail {

Shape stretched(const std::string& block, std::span<const Shape> shapes) {
  const Shape result = elementwise(shapes);
  const bool fit = std::ranges::all_of(shapes, [&](const Shape& shape) {
    return shape.size == 1 ||
           (shape.size > 0 && shape.size == result.size && shape.columns == result.columns);
  });
  if (fit) return result;
  std::string found;
  for (const Shape& shape : shapes) found += (found.empty() ? "" : ", ") + to_string(shape);
  throw ShapeMismatchError(
      text("block '", block, "': expected scalars and signals of one shape, found the shapes ",
           found, "; bring them to one shape, for example with a Multiplexer"));
}

void require_shape(const std::string& block, std::string_view what, const Shape& found,
                   std::string_view state, const Shape& expected) {
  insist(found.size == 1 || found.size == expected.size, block, what, " has ", found.size,
         " values, ", state, " has ", expected.size, "; expected one value or as many");
  insist(found.size == 1 || found.columns == expected.columns, block, what, " has the ",
         in_words(found), ", ", state, " ", in_words(expected),
         "; expected one value or this shape");
}

ShapeRule stretch(std::string block, std::vector<Shape> parameters) {
  return [block = std::move(block),
          parameters = std::move(parameters)](std::span<const Shape> inputs) {
    std::vector<Shape> all = parameters;
    all.insert(all.end(), inputs.begin(), inputs.end());
    return stretched(block, all);
  };
}

std::optional<Index> relation_width(const std::string& block,
                                    const std::vector<Shape>& parameters) {
  const Shape shape = stretched(block, parameters);
  return shape.size > 1 ? std::optional(shape.size) : std::nullopt;
}

}  // namespace saltus::detail
