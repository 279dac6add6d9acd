// y[k] = y[k-1] + dt (w u[k] + (1 - w) u[k-1]), y[0] = the state at the start, elementwise; y is
// held from tick k, at t = k dt, to the next. w = 0: forward; 1: backward; 1/2: trapezoidal.
// Ports, each only if its option is on, in this order: in, reset_trigger, reset_value,
// hold_trigger. in, reset_value and out have the shape of initial_state; each trigger is one
// boolean, read at ticks. Where reset_trigger is true at a tick and was false at the tick before,
// y[k] becomes reset_value, or initial_state. While hold_trigger is true, y does not change.
// Parameters "initial_state" (the value after a reset), "lower_limit", "upper_limit": y is
// between them from the first tick on, after a reset too, and does not wind up. in is read at once
// unless the method is forward; reset ports always.
#pragma once

#include <optional>
#include <string_view>

#include "saltus/library/detail/sampled.hpp"

namespace saltus {

struct IntegratorDiscreteOptions {
  Value initial_state = 0.0;
  std::string_view method = "forward";  ///< forward, backward, trapezoidal
  bool enable_reset = false;            ///< input reset_trigger
  bool enable_external_reset = false;   ///< input reset_value; needs enable_reset
  bool enable_limits = false;           ///< without it the limits below have no effect
  std::optional<Value> lower_limit = {};
  std::optional<Value> upper_limit = {};
  bool enable_hold = false;  ///< input hold_trigger
};

class IntegratorDiscrete final : public detail::SampledSystem {
 public:
  using Options = IntegratorDiscreteOptions;

  IntegratorDiscrete(std::string name, double dt, const Options& options = {});
};

}  // namespace saltus
