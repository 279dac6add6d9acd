// y = the value of a table at u, elementwise.
// in: any width. out: the same width. Parameter "output_array": the values at the points of
// input_array, which are fixed. Between points y is linear, or the value of the nearest point
// (nearest) or of the point before (flat). Beyond them it is the value of the outer point (clip),
// linear, or not a number (error), which ends the run. If y reaches a derivative, the points are
// located, by one guard for all.
#pragma once

#include <string_view>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct LookupTable1dOptions {
  std::string_view interpolation = "linear";  ///< linear, nearest, flat
  std::string_view extrapolation = "clip";    ///< clip, linear, error
};

class LookupTable1d final : public LeafSystem {
 public:
  using Options = LookupTable1dOptions;

  LookupTable1d(std::string name, const Eigen::VectorXd& input_array,
                const Eigen::VectorXd& output_array, const Options& options = {});
};

}  // namespace saltus
