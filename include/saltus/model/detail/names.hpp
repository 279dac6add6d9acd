// Names of the parts of a system: ports, guards, parameters, blocks.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/base/error.hpp"

namespace saltus::detail {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// Names a nameless declaration, and refuses a second declaration with the same name.
template <class List>
void name_it(std::string& name, const List& others, std::string_view prefix,
             const std::string& block) {
  if (name.empty()) name = text(prefix, others.size());
  for (const auto& other : others) {
    if (other.name == name)
      throw ModelError(text("block '", block, "': the name '", name, "' is declared twice"));
  }
}

/// Refuses a name with a dot where names make paths: "ball.x" would be two things. `what` says what
/// is named, such as "block".
inline std::string without_dot(std::string name, std::string_view what) {
  if (std::ranges::find(name, '.') != name.end()) {
    throw ModelError(text(what, " '", name,
                          "': a dot separates the names of a path; expected a name without one, "
                          "such as with '_' in its place"));
  }
  return name;
}

}  // namespace saltus::detail
