// Place: where a name is.
#include "places.hpp"

#include <algorithm>

#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

bool AnalysisPlace::same(const AnalysisPlace& other) const {
  if (is_input() != other.is_input()) return false;
  if (is_input()) return port == other.port && of_vector == other.of_vector;
  return entry->kind == other.entry->kind && entry->first == other.entry->first;
}

int open_port(const System& system, std::string_view name) {
  const std::vector<std::string> names = system.input_names();
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

ContextEntry entry_in(const std::string& where, const Context& context, const std::string& name) {
  try {
    return find_entry(context.layout(), name);
  } catch (const ModelError& error) {
    throw ModelError(text(where, ": ", error.what()));
  }
}

ContextEntry number_in(const std::string& where, const Context& context, const std::string& name) {
  const ContextEntry entry = entry_in(where, context, name);
  if (entry.kind == ContextEntry::Kind::mode)
    throw ModelError(
        text(where, ": '", name, "' is a mode, an integer; expected a parameter or a start value"));
  if (entry.size != 1)
    throw ModelError(text(where, ": '", name, "' has ", entry.size,
                          " entries; name each, such as '", name, "[0]'"));
  detail::require_settable(entry.role, name);
  return entry;
}

AnalysisPlace place_of(const std::string& where, const System& system, const Context& context,
                       const std::string& name) {
  const auto [base, index] = split_index(name);
  if (const int port = open_port(system, name); port >= 0) return {name, {}, port, {}};
  if (const int port = open_port(system, base); port >= 0) return {name, {}, port, index};
  ContextEntry entry;
  try {
    entry = number_in(where, context, name);
  } catch (const ModelError& error) {
    const std::vector<std::string> ports = system.input_names();
    const std::string hint = ports.empty() ? "" : text("; open inputs", known_names(name, ports));
    throw ModelError(error.what() + hint);
  }
  if (entry.kind == ContextEntry::Kind::discrete_state)
    throw ModelError(text(where, ": '", name,
                          "' is a discrete state, which keeps its value; expected a continuous "
                          "state, a parameter or an open input; set it in the context"));
  return {name, entry, -1, {}};
}

double value_in(const Context& context, const ContextEntry& entry) {
  using Kind = ContextEntry::Kind;
  if (entry.kind == Kind::parameter) return context.parameters()[entry.first];
  if (entry.kind == Kind::continuous_state) return context.continuous_state()[entry.first];
  return context.discrete_state()[entry.first];
}

Context with_number(const Context& context, const ContextEntry& entry, double value,
                    const std::string& name) {
  Context with = context;
  write_entry(with, entry, {&value, 1}, name);
  return with;
}

std::vector<std::string> continuous_names(const Context& context) {
  std::vector<std::string> names;
  const Layout& layout = context.layout();
  for (const Layout::Leaf& leaf : layout.leaves)
    for (Index i = 0; i < leaf.nx; ++i)
      names.push_back(
          layout.name_of(leaf, leaf.states.empty() ? text("x[", i, "]") : nth(leaf.states, i)));
  return names;
}

std::vector<std::string> discrete_names(const Context& context) {
  std::vector<std::string> names;
  const Layout& layout = context.layout();
  for (const Layout::Leaf& leaf : layout.leaves)
    for (Index i = 0; i < leaf.nz; ++i) names.push_back(layout.name_of(leaf, text("z[", i, "]")));
  return names;
}

}  // namespace saltus
