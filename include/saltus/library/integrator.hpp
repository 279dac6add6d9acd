// dx/dt = u, y = x, elementwise; on a rising edge of reset_trigger x becomes reset_value, or
// initial_state.
// Ports, each only if its option is on, in this order: in, reset_trigger, reset_value,
// hold_trigger. in, reset_value and out have the shape of initial_state; each trigger is one
// boolean. out is a view of the state, without feedthrough. Parameters "initial_state" (the value
// after a reset; the state itself is in the context), "lower_limit", "upper_limit".
// With limits an entry remains constant while it is at its limit and pushed outward, and moves
// again when u turns. Both facts are relations, so the derivative is smooth between instants. The
// engine provides the Zeno hold after ever faster resets.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct IntegratorOptions {
  Value initial_state = 0.0;
  bool enable_reset = false;                  ///< input reset_trigger
  bool enable_external_reset = false;         ///< input reset_value; needs enable_reset
  std::optional<double> zeno_tolerance = {};  ///< [s] overrides that of the simulator options
  bool enable_limits = false;                 ///< without it the limits below have no effect
  std::optional<Value> lower_limit = {};
  std::optional<Value> upper_limit = {};
  bool enable_hold = false;  ///< input hold_trigger: dx/dt = 0 while it is true
};

class Integrator final : public LeafSystem {
 public:
  using Options = IntegratorOptions;

  explicit Integrator(std::string name, const Options& options = {});

 private:
  void require_sound(const Options& options) const;
  void declare_ports(const Options& options);
  void declare_reset(const Options& options);
  void declare_limits(const Options& options);
  void declare_state(const Options& options);
  Formula flow(bool limits) const;

  void reset(const At& at, Next& next) const;

  std::optional<int> trigger_, value_, hold_;  // inputs
  std::optional<ParameterIndex> lower_, upper_;
  ParameterIndex initial_;
  RelationIndex at_lower_, at_upper_, rising_;
};

}  // namespace saltus
