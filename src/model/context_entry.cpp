// ContextEntry: the names of values, and how they are found and written.
#include "saltus/model/context_entry.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "saltus/base/list.hpp"

namespace saltus {

namespace {

/// All entries of one leaf, by their names within the leaf.
std::vector<std::pair<std::string, ContextEntry>> entries_of(const Layout::Leaf& leaf,
                                                             Index number) {
  using Kind = ContextEntry::Kind;
  std::vector<std::pair<std::string, ContextEntry>> all;
  for (const auto& parameter : leaf.parameters)
    all.push_back({parameter.name,
                   {Kind::parameter, leaf.p + parameter.offset, parameter.size, parameter.role}});
  if (leaf.nx > 0) all.push_back({"x", {Kind::continuous_state, leaf.x, leaf.nx}});
  for (Index i = 0; i < std::ssize(leaf.states); ++i)
    all.push_back({nth(leaf.states, i), {Kind::continuous_state, leaf.x + i, 1}});
  if (leaf.nz > 0) all.push_back({"z", {Kind::discrete_state, leaf.z, leaf.nz}});
  if (!leaf.of_diagram) all.push_back({"mode", {Kind::mode, number, 1}});
  return all;
}

/// Refuses a name that a parameter shares with a state or the mode of its block.
void require_single(const Layout::Leaf& leaf, const std::string& local, std::string_view name) {
  const auto all = entries_of(leaf, 0);
  if (std::ranges::count(all, local, &std::pair<std::string, ContextEntry>::first) > 1) {
    throw ModelError(text("'", name, "' is a parameter of block '", leaf.path, "' and its ", local,
                          " too; rename the parameter, or set it by with_parameter"));
  }
}

/// Adds an entry to a list of names: a short vector entry by entry, and a state too.
void add_names(std::vector<std::string>& names, const std::string& prefix, const std::string& local,
               const ContextEntry& entry) {
  const bool one = entry.size == 1 && local != "x" && local != "z";
  if (one || entry.size > 4) return names.push_back(prefix + local);
  for (Index i = 0; i < entry.size; ++i) names.push_back(text(prefix, local, "[", i, "]"));
}

/// The largest number of a mode: a double has all integers up to here, and so has an int.
constexpr double most_mode = 1e9;

/// Throws unless an entry of this kind may have the value.
void require_possible(double value, ContextEntry::Kind kind, std::string_view name) {
  const bool mode = kind == ContextEntry::Kind::mode;
  const bool possible =
      mode ? value == std::trunc(value) && std::abs(value) <= most_mode : std::isfinite(value);
  if (!possible)
    throw ModelError(
        text("'", name, "' is ", value, "; give ", mode ? "an integer" : "a finite value"));
}

}  // namespace

std::pair<std::string_view, std::optional<Index>> split_index(std::string_view name) {
  const auto open = name.rfind('[');
  if (open == std::string_view::npos || !name.ends_with(']')) return {name, {}};
  Index index = 0;
  const char* last = name.data() + name.size() - 1;
  const auto [end, error] = std::from_chars(name.data() + open + 1, last, index);
  if (error != std::errc() || end != last || index < 0) return {name, {}};
  return {name.substr(0, open), index};
}

std::vector<std::string> entry_names(const Layout& layout) {
  std::vector<std::string> names;
  for (std::size_t l = 0; l < layout.leaves.size(); ++l) {
    const Layout::Leaf& leaf = layout.leaves[l];
    const std::string prefix = layout.name_of(leaf, "");
    for (const auto& [name, entry] : entries_of(leaf, static_cast<Index>(l))) {
      const bool named = name == "x" && !leaf.states.empty();
      if (!named && entry.role != Layout::Role::computed) add_names(names, prefix, name, entry);
    }
  }
  return names;
}

ContextEntry find_entry(const Layout& layout, std::string_view name) {
  const auto [whole, index] = split_index(name);
  for (std::size_t l = 0; l < layout.leaves.size(); ++l) {
    const Layout::Leaf& leaf = layout.leaves[l];
    for (auto& [local, entry] : entries_of(leaf, static_cast<Index>(l))) {
      const bool alone = local == whole && layout.is_alone(leaf);
      if (!alone && whole != joined_name(leaf.path, local)) continue;
      require_single(leaf, local, name);
      if (!index) return entry;
      if (*index < entry.size) return {entry.kind, entry.first + *index, 1, entry.role};
      throw ModelError(text("'", name, "': '", whole, "' has ", entry.size,
                            " entries, the first is ", whole, "[0]"));
    }
  }
  throw ModelError(
      text("unknown parameter or state '", name, "'", known_names(name, entry_names(layout))));
}

void require_width(const ContextEntry& entry, Index given, std::string_view name) {
  const bool fills = given == 1 && entry.kind == ContextEntry::Kind::parameter;
  if (fills || given == entry.size) return;
  throw ModelError(text("'", name, "': expected ", entry.size, " values, found ", given,
                        given == 1 ? text("; one entry is '", name, "[0]'") : std::string()));
}

void write_entry(Context& context, const ContextEntry& entry, std::span<const double> values,
                 std::string_view name) {
  using Kind = ContextEntry::Kind;
  detail::require_settable(entry.role, name);
  const auto given = static_cast<Index>(values.size());
  require_width(entry, given, name);
  for (Index i = 0; i < entry.size; ++i) {
    const double value = nth(values, given == 1 ? 0 : i);
    require_possible(value, entry.kind, name);
    const Index at = entry.first + i;
    switch (entry.kind) {
      case Kind::parameter:
        context.p_[at] = value;
        break;
      case Kind::continuous_state:
        context.x_[at] = value;
        break;
      case Kind::discrete_state:
        context.z_[at] = value;
        break;
      case Kind::mode:
        context.modes_[at] = static_cast<int>(value);
    }
  }
  if (entry.kind == Kind::parameter) context.compute_parameters();
  context.continuation_.reset();  // the continuation belongs to the old values
}

}  // namespace saltus
