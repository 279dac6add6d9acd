// The enums of events, found by name.
#include "saltus/model/event.hpp"

namespace saltus {

Direction direction_from(std::string_view name) {
  return detail::value_of(direction_names, "direction", name);
}

AtStart at_start_from(std::string_view name) {
  return detail::value_of(at_start_names, "at_start", name);
}

}  // namespace saltus
