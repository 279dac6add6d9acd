// A recorded signal by its name, among those of the rows, of a moment, or of its derivatives.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "saltus/base/error.hpp"

namespace saltus::detail {

/// The item with this name, which `name_of` gives. Throws ModelError with the nearest name if there is
/// none.
template <class Items, class NameOf>
const auto& recorded_under(const Items& items, std::string_view name, NameOf name_of) {
  const auto found = std::ranges::find(items, name, name_of);
  if (found != items.end()) return *found;
  std::vector<std::string> known;
  std::ranges::transform(items, std::back_inserter(known), name_of);
  throw ModelError(text("nothing was recorded under '", name, "'", known_names(name, known)));
}

}  // namespace saltus::detail
