// Buses: signals with names that go together through one wire, a vector.
#include "saltus/library/bus.hpp"

#include <algorithm>

#include "saltus/base/error.hpp"

namespace saltus {

namespace {

/// A signal of a bus, or a bus within it: entries first to first + shape.size - 1.
struct Part {
  std::string name;
  Shape shape;
  Index first = 0;
};

/// A layout as parts, cut at the first dot of each name: neighbours of one name are one vector.
std::vector<Part> inputs_of(const BusLayout& layout) {
  std::vector<Part> parts;
  Index first = 0;
  for (const auto& [name, shape] : layout) {
    const std::size_t dot = name.find('.');
    const std::string head = name.substr(0, dot);
    if (dot != std::string::npos && !parts.empty() && parts.back().name == head)
      parts.back().shape.size += shape.size;
    else
      parts.push_back({head, dot == std::string::npos ? shape : Shape::of(shape.size), first});
    first += shape.size;
  }
  return parts;
}

/// The part of a name: a signal, or all signals whose names go on with a dot.
Part part_of(const std::string& block, const BusLayout& layout, const std::string& name) {
  Part found{name, Shape::of(0)};
  Index first = 0;
  std::vector<std::string> names;
  for (const BusSignal& signal : layout) {
    if (signal.name == name) return {name, signal.shape, first};
    if (signal.name.starts_with(name + ".")) {
      if (found.shape.size == 0) found.first = first;
      found.shape.size += signal.shape.size;
    }
    first += signal.shape.size;
    names.push_back(signal.name);
  }
  detail::insist(found.shape.size > 0, block, "the bus has no signal '", name, "'",
                 known_names(name, names));
  return found;
}

/// Returns the width of a bus. Refuses names that are empty or not unique.
Index require_layout(const std::string& block, const BusLayout& layout) {
  detail::insist(!layout.empty(), block, "a bus without signals; give one name or more");
  std::vector<std::string> heads;
  for (const Part& part : inputs_of(layout)) heads.push_back(part.name);
  for (const std::string& head : heads)
    detail::insist(std::ranges::count(heads, head) == 1, block, "the signal '", head,
                   "' is in the bus twice; the parts of a bus within it are side by side");
  Index width = 0;
  for (const auto& [name, shape] : layout) {
    detail::insist(!name.empty() && !name.starts_with('.') && !name.ends_with('.'), block,
                   "a signal has the name '", name, "'; expected words with dots between them");
    detail::insist(shape.size > 0, block, "the signal '", name, "' has the width ", shape.size,
                   "; expected 1 or more");
    detail::insist(std::ranges::count(layout, name, &BusSignal::name) == 1, block, "the signal '",
                   name, "' is in the bus twice");
    width += shape.size;
  }
  return width;
}

}  // namespace

BusCreator::BusCreator(std::string name, const BusLayout& layout) : LeafSystem(std::move(name)) {
  const Index width = require_layout(this->name(), layout);
  for (const Part& part : inputs_of(layout))
    declare_input_port({.name = part.name, .shape = part.shape});
  declare_output_port({.name = "bus",
                       .shape = Shape::of(width),
                       .reads = Reads::inputs,
                       .entries =
                           [](Index i, int k, std::span<const Index> widths) {
                             for (int before = 0; before < k; ++before)
                               i -= widths[static_cast<std::size_t>(before)];
                             const bool inside = i >= 0 && i < widths[static_cast<std::size_t>(k)];
                             return inside ? EntryRange{i, i + 1} : EntryRange{};
                           },
                       .formula =
                           [](const auto& at, Index i) {
                             int k = 0;
                             while (i >= at.width(k)) i -= at.width(k++);
                             return at.u(k, i);
                           }});
}

BusSelector::BusSelector(std::string name, const BusLayout& layout,
                         const std::vector<std::string>& names)
    : LeafSystem(std::move(name)) {
  const Index width = require_layout(this->name(), layout);
  detail::insist(!names.empty(), this->name(), "no signal is chosen; give one name or more");
  declare_input_port({.name = "in", .shape = Shape::of(width)});
  for (const std::string& chosen : names) {
    const Part part = part_of(this->name(), layout, chosen);
    std::string port = chosen;
    std::ranges::replace(port, '.', '_');
    declare_output_port(
        {.name = port,
         .shape = part.shape,
         .reads = Reads::inputs,
         .entries = [first = part.first](
                        Index i, int,
                        std::span<const Index>) { return EntryRange{first + i, first + i + 1}; },
         .formula = [first = part.first](const auto& at, Index i) { return at.u(0, first + i); }});
  }
}

}  // namespace saltus
