// y = the chosen entries of u.
#include "saltus/library/slice.hpp"

#include <algorithm>
#include <functional>

#include "saltus/library/arguments.hpp"

namespace saltus {

namespace {

using Choice = std::function<std::vector<Index>(Index width)>;

/// An index from the front; a ModelError if there is no such entry.
Index entry_of(const std::string& block, Index entry, Index width) {
  detail::insist(entry >= -width && entry < width, block, "there is no entry ", entry,
                 " of an input of width ", width, "; expected ", -width, " to ", width - 1);
  return entry < 0 ? entry + width : entry;
}

/// The entries of a range. As in Python, its ends may lie outside the vector.
std::vector<Index> entries_of(const SliceRange& range, Index width) {
  const bool forward = range.step > 0;
  const auto bound = [&](std::optional<Index> given, Index otherwise) {
    if (!given) return otherwise;
    const Index from_front = *given < 0 ? *given + width : *given;
    return std::clamp(from_front, forward ? Index{0} : Index{-1}, forward ? width : width - 1);
  };
  const Index start = bound(range.start, forward ? 0 : width - 1);
  const Index stop = bound(range.stop, forward ? width : -1);
  std::vector<Index> entries;
  for (Index i = start; forward ? i < stop : i > stop; i += range.step) entries.push_back(i);
  return entries;
}

Choice listed(std::string block, std::vector<Index> entries) {
  return [block = std::move(block), entries = std::move(entries)](Index width) {
    std::vector<Index> found;
    for (const Index entry : entries) found.push_back(entry_of(block, entry, width));
    return found;
  };
}

OutputDeclaration chosen(const std::string& block, const Choice& choice, bool scalar) {
  return {.name = "out",
          .shape = {},
          .shape_rule =
              [block, choice, scalar](std::span<const Shape> inputs) {
                const auto size = static_cast<Index>(choice(inputs[0].size).size());
                detail::insist(size > 0, block, "no entry of an input of width ", inputs[0].size,
                               " is chosen; choose at least one");
                return scalar ? Shape::scalar() : Shape::of(size);
              },
          .reads = Reads::inputs,
          .entries =
              [choice](Index i, int, std::span<const Index> widths) {
                const Index entry = choice(widths[0])[static_cast<std::size_t>(i)];
                return EntryRange{entry, entry + 1};
              },
          .formula = Formula(
              [choice](const At& at, VectorRef out) {
                const auto entries = choice(at.u[0].size());
                for (Index i = 0; i < out.size(); ++i)
                  out[i] = at.u[0][entries[static_cast<std::size_t>(i)]];
              },
              [choice](detail::Symbols& of) {
                std::vector<tape::Symbol> values;
                for (const Index entry : choice(of.width(0))) values.push_back(of.input(0, entry));
                return values;
              })};
}

}  // namespace

Slice::Slice(std::string name, Index entry) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port(chosen(this->name(), listed(this->name(), {entry}), true));
}

Slice::Slice(std::string name, std::vector<Index> entries) : LeafSystem(std::move(name)) {
  declare_input_port({.name = "in"});
  declare_output_port(chosen(this->name(), listed(this->name(), std::move(entries)), false));
}

Slice::Slice(std::string name, const Range& range) : LeafSystem(std::move(name)) {
  detail::insist(range.step != 0, this->name(), "step = 0; expected a step that is not 0");
  declare_input_port({.name = "in"});
  const Choice choice = [range](Index width) { return entries_of(range, width); };
  declare_output_port(chosen(this->name(), choice, false));
}

}  // namespace saltus
