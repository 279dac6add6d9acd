// y_i = u_i, with the entries counted row by row.
#include "saltus/library/reshape.hpp"

#include "saltus/library/detail/arguments.hpp"
#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Reshape::Reshape(std::string name, Shape shape) : LeafSystem(std::move(name)) {
  detail::insist(shape.size > 0, this->name(), "shape is ", to_string(shape),
                 "; expected at least one entry");
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule =
                           [shape, block = this->name()](std::span<const Shape> in) {
                             if (in[0].size == shape.size) return shape;
                             throw ShapeMismatchError(
                                 text("block '", block, "': expected ", shape.size, " entries for ",
                                      in_words(shape), ", found ", in_words(in[0])));
                           },
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [](const auto& at, Index i) { return at.u(0, i); }});
}

}  // namespace saltus
