// The enums of events, found by name.
#include "saltus/model/event.hpp"

#include <algorithm>

#include "saltus/base/list.hpp"

namespace saltus {

Direction direction_from(std::string_view name) {
  return detail::value_of(direction_names, "direction", name);
}

AtStart at_start_from(std::string_view name) {
  return detail::value_of(at_start_names, "at_start", name);
}

std::vector<int> Touches::of_guard(int entry) const {
  std::vector<int> entries = nth(reads, entry);
  entries.insert(entries.end(), writes.begin(), writes.end());
  std::ranges::sort(entries);
  const auto same = std::ranges::unique(entries);
  entries.erase(same.begin(), same.end());
  return entries;
}

}  // namespace saltus
