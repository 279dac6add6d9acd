// The counts of a solver.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace saltus {

/// Counts, summed across restarts.
struct SolverStatistics {
  std::int64_t steps = 0;  ///< accepted
  std::int64_t rejected = 0;
  std::int64_t restarts = 0;
  std::int64_t linear_setups = 0;
  std::string linear_solver = {};  ///< name, size and reason; empty without a stiff method
};

/// A time over which one method was used.
struct Stretch {
  std::string method = {};
  double begin = 0.0, end = 0.0;  ///< [s]
  std::int64_t steps = 0;         ///< accepted
};

}  // namespace saltus
