// FlowSeries: the derivatives and the guards of a plan as Taylor series, kept with the plan.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"
#include "saltus/tape/series.hpp"

namespace saltus {

/// The series of the states. Its outputs are the guards whose series show their crossings: guards
/// that have no kinks and hide nothing.
struct FlowSeries {
  static constexpr int no_output = -1;

  std::optional<tape::Series> series = {};  ///< each user takes a copy; if none, see `obstacle`
  std::vector<int> output_of_slot = {};     ///< the number of the output of each guard, or none
  bool hides = false;                       ///< a derivative may hide a part of itself: `may_hide`
  std::string obstacle = {};                ///< the first reason why there is no series
};

/// The series that the plan keeps; the first call makes it.
std::shared_ptr<const FlowSeries> flow_series(const Plan& plan);

}  // namespace saltus
