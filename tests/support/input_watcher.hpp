// A block that logs where a guard of its input fires.
#pragma once

#include <memory>
#include <string>

#include "support/cases.hpp"

namespace support {

/// Logs "hit" where guard(u) of the scalar input "u" fires; `counts`: with a reset map, otherwise it is a
/// monitor.
template <class Guard>
std::shared_ptr<Leaf> input_watcher(std::string name, Guard guard, bool counts) {
  return make_leaf(std::move(name), [=](Leaf& l) {
    const int in = l.declare_input_port({.name = "u", .shape = saltus::Shape::scalar()});
    l.declare_discrete_state(vec({0.0}));
    l.declare_zero_crossing(
        {.name = "hit",
         .guard = [=](const At& at) { return guard(at.u[in][0]); },
         .reset_map = counts ? saltus::ResetMap(count_up) : saltus::ResetMap()});
  });
}

}  // namespace support
