// Edge series: firings of edge_detection so close to each other that its guard varies all the time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "saltus/base/error.hpp"
#include "saltus/solver/detail/search_thresholds.hpp"
#include "saltus/solver/detail/thresholds.hpp"

namespace saltus {

/// The guard of a block fires without end (docs/semantics.md, 4.7). The run takes the step back in
/// which this was seen, and ends as `chattering`.
class ChatteringError : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

/// The firings of one guard of edge_detection inside the steps of a run, each close to the one before.
struct EdgeSeries {
  /// A firing, found between two looks that were narrowed to it.
  struct Firing {
    double t = 0.0;       ///< [s]
    double step = 0.0;    ///< [s] the length of the step in which it is
    double change = 0.0;  ///< of the guard's value since the last firing
    double value = 0.0;   ///< the largest of the two
  };

  /// Whether a firing is as close to the last one as those of a value that varies all the time:
  ///
  ///     its value has changed by                           the time since the last firing    close
  ///     some roundings                                     any                               yes
  ///     more                                               some resolutions of the time      yes
  ///     more                                               a very small part of the step     yes
  ///     more, as a truth, a held number or a staircase     longer                            no
  bool is_close(const Firing& now) const {
    if (now.change <= thresholds::edge_roundings * thresholds::eps * now.value) return true;
    const double gap = now.t - last;  // NaN before the first firing: not close
    return gap <= std::max(thresholds::edge_gap * thresholds::eps * std::abs(now.t),
                           thresholds::edge_share * now.step);
  }

  /// Counts a firing. True if so many were close to each other that there is no end to them.
  bool is_endless(const Firing& now) {
    count = is_close(now) ? count + 1 : 0;
    if (count == 0 || std::isnan(last)) since = now.t;
    last = now.t;
    return count >= thresholds::endless_edges;
  }

  std::int64_t count = 0;
  double since = 0.0;                                      ///< [s] the first firing of the series
  double last = std::numeric_limits<double>::quiet_NaN();  ///< [s] the last firing
};

}  // namespace saltus
