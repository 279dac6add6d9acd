// y(t) = u(k dt) for k dt <= t < (k+1) dt.
// in, out: the shape of initial_state, the value before the first tick. Ticks are exact time
// events. y is a view of the discrete state, so it costs nothing. A block that samples y at the
// same tick gets the value before it.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct ZeroOrderHoldOptions {
  Value initial_state = 0.0;  ///< its shape is the shape of the signal
};

class ZeroOrderHold final : public LeafSystem {
 public:
  using Options = ZeroOrderHoldOptions;

  ZeroOrderHold(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
