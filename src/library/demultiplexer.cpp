// y_k = part k of u, which is cut into n_outputs equal parts.
#include "saltus/library/demultiplexer.hpp"

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

Demultiplexer::Demultiplexer(std::string name, int n_outputs) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "output", n_outputs, 1);
  declare_input_port({.name = "in"});
  const auto part = [block = this->name(), n_outputs](std::span<const Shape> inputs) {
    detail::require_no_matrix(block, inputs[0]);
    const Index width = inputs[0].size;
    detail::insist(width % n_outputs == 0, block, "an input of width ", width,
                   " cannot be cut into ", n_outputs,
                   " equal parts; expected a multiple of n_outputs");
    return width == n_outputs ? Shape::scalar() : Shape::of(width / n_outputs);
  };
  for (int k = 0; k < n_outputs; ++k) {
    const auto entries = [k, n_outputs](Index i, int, std::span<const Index> widths) {
      const Index at = k * (widths[0] / n_outputs) + i;
      return EntryRange{at, at + 1};
    };
    declare_output_port({.shape = {},
                         .shape_rule = part,
                         .reads = Reads::inputs,
                         .entries = entries,
                         .formula = [k, n_outputs](const auto& at, Index i) {
                           return at.u(0, k * (at.width(0) / n_outputs) + i);
                         }});
  }
}

}  // namespace saltus
