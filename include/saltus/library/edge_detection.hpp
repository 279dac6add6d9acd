// y[k] = 1 if the truth of u changed from tick k - 1 to tick k, at t = k dt, in the direction of
// the edge; otherwise 0. in: one boolean, true if not 0. out: boolean, held to the next tick.
#pragma once

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct EdgeDetectionOptions {
  Edge edge = Edge::rising;
  bool initial_state = false;  ///< the truth of u before the first tick
};

class EdgeDetection final : public detail::SampledSystem {
 public:
  using Options = EdgeDetectionOptions;

  EdgeDetection(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
