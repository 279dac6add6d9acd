// y = (u_0; u_1; ...): the inputs in order.
#include "saltus/library/multiplexer.hpp"

#include "saltus/base/list.hpp"
#include "saltus/library/detail/arguments.hpp"

namespace saltus {

Multiplexer::Multiplexer(std::string name, int n_inputs) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "input", n_inputs, 1);
  for (int k = 0; k < n_inputs; ++k) declare_input_port();
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = &Multiplexer::total,
                       .reads = Reads::inputs,
                       .entries = &Multiplexer::entries,
                       .formula = [](const auto& at, Index i) {
                         int k = 0;
                         while (i >= at.width(k)) i -= at.width(k++);
                         return at.u(k, i);
                       }});
}

Shape Multiplexer::total(std::span<const Shape> inputs) {
  Index size = 0;
  for (const Shape& shape : inputs) size += shape.size;
  return Shape::of(size);
}

EntryRange Multiplexer::entries(Index i, int k, std::span<const Index> widths) {
  for (int before = 0; before < k; ++before) i -= nth(widths, before);
  return i >= 0 && i < nth(widths, k) ? EntryRange{i, i + 1} : EntryRange{};
}

}  // namespace saltus
