// All groups, in the order of the page.
#pragma once

#include "extremes/ends.hpp"
#include "extremes/fast.hpp"
#include "extremes/tolerances.hpp"

namespace extremes {

inline std::vector<Group> all_groups() {
  return {sizes_of_states(), balls(), horizons(), tolerances(), many(), fast(), ends()};
}

}  // namespace extremes
