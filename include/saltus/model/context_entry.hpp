// ContextEntry: the place of the values with one name in a context.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/model/context.hpp"

namespace saltus {

/// Some values of a context, found by name once and written often. Names are the names of
/// parameters, "g", and of the states: "x" and "z" for the whole state of a block, "x[0]" for one
/// entry, "mode". In a diagram the path of the block is put before the name: "ball.g", "ball.x[0]".
/// An entry of a vector parameter is "k[2]". A state that has a name is found by it too, "height".
struct ContextEntry {
  enum class Kind { parameter, continuous_state, discrete_state, mode };
  Kind kind = Kind::parameter;
  Index first = 0;  ///< in the vector of all values of its kind
  Index size = 1;
  Layout::Role role = Layout::Role::own;  ///< of a parameter
};

/// The names of the entries that can be written, in the order of the blocks; a long vector has one
/// name.
std::vector<std::string> entry_names(const Layout& layout);

/// "x[3]" as ("x", 3); "x" as ("x", none).
std::pair<std::string_view, std::optional<Index>> split_index(std::string_view name);

/// Throws ModelError for an unknown name, with the nearest one, and for an index out of range.
ContextEntry find_entry(const Layout& layout, std::string_view name);

/// Throws ModelError unless the entry takes so many values: as many as it has. One value fills a
/// parameter, but not several states.
void require_width(const ContextEntry& entry, Index given, std::string_view name);

/// Writes `values` in place: as many as the entry has, or a single value that fills a parameter. Throws
/// ModelError for a wrong number of values, for one value of several states, a value that is not finite, a mode that is not an
/// integer, and a parameter that is computed from those of a diagram.
void write_entry(Context& context, const ContextEntry& entry, std::span<const double> values,
                 std::string_view name);

}  // namespace saltus
