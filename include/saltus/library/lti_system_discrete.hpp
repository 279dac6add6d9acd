// x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k]; y is held from tick k, at t = k dt, to the
// next.
// in: scalar if B has one column, otherwise a vector. out: scalar if C has one row, otherwise a
// vector; C x[0] before the first tick. Parameters "A", "B", "C", "D", each matrix row by row.
// Without D, or with a D of zeros, there is no feedthrough and no parameter "D".
#pragma once

#include "saltus/library/detail/sampled.hpp"
#include "saltus/library/lti_system.hpp"

namespace saltus {

class LTISystemDiscrete final : public detail::SampledSystem {
 public:
  using Matrices = LTISystemMatrices;
  using Options = LTISystemOptions;

  LTISystemDiscrete(std::string name, double dt, const Matrices& matrices,
                    const Options& options = {});
};

}  // namespace saltus
