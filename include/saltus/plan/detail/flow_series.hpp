// FlowSeries: the derivatives and the guards of a plan as Taylor series, kept with the plan.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/tape/series.hpp"

namespace saltus {

/// The series of the states, with those guards as outputs whose series show them: they have no
/// kinks, and hide nothing.
struct FlowSeries {
  static constexpr int no_output = -1;

  std::optional<tape::Series> series = {};  ///< each user takes a copy; none: see `obstacle`
  std::vector<int> output_of_slot = {};     ///< the number of the output of each guard, or none
  bool hides = false;                       ///< a derivative may hide a part of itself, `may_hide`
  std::string obstacle = {};                ///< the first reason why there is no series
};

/// As the plan keeps it.
std::shared_ptr<const FlowSeries> flow_series(const Plan& plan);

}  // namespace saltus
