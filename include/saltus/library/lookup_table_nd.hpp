// y = the value of a table at (u_0, u_1, ...), linear along each input in each cell, elementwise.
// in_0, in_1, ...: one for each axis, scalars and vectors of one width. out: that width. Parameter
// "output_table": the value at each crossing of the points, the last axis first; the points are
// fixed. Beyond the table y is the value at the border (clip), linear, or not a number (error),
// which ends the run. If y reaches a derivative, the points are located, by one guard for each
// input. A value takes 2^n products for n inputs.
#pragma once

#include <string_view>
#include <vector>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct LookupTableNdOptions {
  std::string_view extrapolation = "clip";  ///< clip, linear, error
};

class LookupTableNd final : public LeafSystem {
 public:
  using Options = LookupTableNdOptions;

  /// The points of each input, which increase, and as many values as the product of their numbers.
  LookupTableNd(std::string name, const std::vector<Eigen::VectorXd>& input_axes,
                const Eigen::VectorXd& output_table, const Options& options = {});
};

}  // namespace saltus
