// y = the chosen entries of u.
#include "saltus/library/slice.hpp"

#include <algorithm>

#include "saltus/library/detail/matrix_arguments.hpp"

namespace saltus {

namespace {

/// The entries of a range of a vector of one width. As in Python, its ends may lie outside of it.
struct Bounds {
  Index start = 0, size = 0;

  Bounds(const SliceRange& range, Index width) {
    const bool forward = range.step > 0;
    const auto bound = [&](std::optional<Index> given, Index otherwise) {
      if (!given) return otherwise;
      const Index from_front = *given < 0 ? *given + width : *given;
      return std::clamp(from_front, forward ? Index{0} : Index{-1}, forward ? width : width - 1);
    };
    start = bound(range.start, forward ? 0 : width - 1);
    const Index distance = bound(range.stop, forward ? width : -1) - start;
    if (distance != 0 && (distance > 0) == forward) {
      const Index last = distance > 0 ? distance - 1 : distance + 1;
      size = last / range.step + 1;
    }
  }
};

/// A list of entries, or a range if the list is empty.
struct Chosen {
  std::vector<Index> list;
  SliceRange range;

  Index size(Index width) const {
    return list.empty() ? Bounds(range, width).size : static_cast<Index>(list.size());
  }
  Index entry(Index i, Index width) const {
    if (list.empty()) return Bounds(range, width).start + i * range.step;
    const Index given = list[static_cast<std::size_t>(i)];
    return given < 0 ? given + width : given;
  }
};

Shape chosen_shape(const std::string& block, const Chosen& chosen, bool scalar, Index width) {
  const Index size = chosen.size(width);
  detail::insist(size > 0, block, "no entry of an input of width ", width,
                 " is chosen; choose at least one");
  for (Index i = 0; i < size; ++i) {
    const Index entry = chosen.entry(i, width);
    detail::insist(entry >= 0 && entry < width, block, "there is no entry ",
                   chosen.list.empty() ? entry : chosen.list[static_cast<std::size_t>(i)],
                   " of an input of width ", width, "; expected ", -width, " to ", width - 1);
  }
  return scalar ? Shape::scalar() : Shape::of(size);
}

OutputDeclaration output_of(const std::string& block, const Chosen& chosen, bool scalar) {
  return {
      .name = "out",
      .shape = {},
      .shape_rule =
          [=](std::span<const Shape> inputs) {
            detail::require_no_matrix(block, inputs[0]);
            return chosen_shape(block, chosen, scalar, inputs[0].size);
          },
      .reads = Reads::inputs,
      .entries =
          [=](Index i, int, std::span<const Index> widths) {
            const Index entry = chosen.entry(i, widths[0]);
            return EntryRange{entry, entry + 1};
          },
      .formula = [=](const auto& at, Index i) { return at.u(0, chosen.entry(i, at.width(0))); }};
}

}  // namespace

Slice::Slice(std::string name, Index entry) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port(output_of(this->name(), {{entry}, {}}, true));
}

Slice::Slice(std::string name, std::vector<Index> entries) : LeafSystem(std::move(name)) {
  detail::insist(!entries.empty(), this->name(),
                 "the list of entries is empty; choose at least one");
  declare_input_port({.name = "in"});
  declare_output_port(output_of(this->name(), {std::move(entries), {}}, false));
}

Slice::Slice(std::string name, const Range& range) : LeafSystem(std::move(name)) {
  detail::insist(range.step != 0, this->name(), "step = 0; expected a step that is not 0");
  declare_input_port({.name = "in"});
  declare_output_port(output_of(this->name(), {{}, range}, false));
}

}  // namespace saltus
