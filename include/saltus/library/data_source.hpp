// y = the values of a table over the time, from values at increasing times.
// out: scalar for one column of values, otherwise one entry for each column. Parameter "values",
// row by row. Between two times y is linear, or the value of the time before (zero_order_hold,
// which is held). Before the first time, and from the last time on, it is the outer value (hold) or
// zero. All times are exact events: no solver step spans one of them.
#pragma once

#include <string_view>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct DataSourceOptions {
  std::string_view interpolation = "linear";  ///< linear, zero_order_hold
  std::string_view extrapolation = "hold";    ///< hold, zero
};

class DataSource final : public LeafSystem {
 public:
  using Options = DataSourceOptions;

  /// One row of values for each time [s].
  DataSource(std::string name, const Eigen::VectorXd& times, const Eigen::MatrixXd& values,
             const Options& options = {});
};

}  // namespace saltus
