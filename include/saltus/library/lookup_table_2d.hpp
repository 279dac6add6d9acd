// y = the value of a table at (u_0, u_1), bilinear in each cell, elementwise.
// in_0, in_1: scalars and vectors of one width. out: that width. Parameter "output_table": entry
// (i, j) is the value at input_x[i], input_y[j], row by row; the points are fixed. Beyond the table
// y is the value at the border (clip), linear, or not a number (error), which ends the run. If y
// reaches a derivative, the points are located, by one guard for each input.
#pragma once

#include <string_view>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct LookupTable2dOptions {
  std::string_view extrapolation = "clip";  ///< clip, linear, error
};

class LookupTable2d final : public LeafSystem {
 public:
  using Options = LookupTable2dOptions;

  LookupTable2d(std::string name, const Eigen::VectorXd& input_x, const Eigen::VectorXd& input_y,
                const Eigen::MatrixXd& output_table, const Options& options = {});
};

}  // namespace saltus
