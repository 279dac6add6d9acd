// The output of an EnabledSubsystem or a TriggeredSubsystem.
// Ports: in, control, out. in and out have the shape of initial_output; control is one held truth.
// Enabled:   y = u while control is true. While it is false, y is u at the end of the last time that
//            control was true, or initial_output if there was none or if the option resets is on.
// Triggered: y is u at the last edge of control, before the states have changed there;
//            initial_output before the first edge. As with a ZeroOrderHold, a block that reads y at
//            the edge itself reads the value before.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct SubsystemOutputOptions {
  Value initial_output = 0.0;  ///< y before the control signal is first true, or has its first edge
  Execution execution = {};    ///< with `resets` y = initial_output while control is false
};

class SubsystemOutput final : public LeafSystem {
 public:
  using Options = SubsystemOutputOptions;

  SubsystemOutput(std::string name, const Options& options);

 private:
  void declare_enabled(const Shape& shape, bool resets);
  void declare_triggered(const Shape& shape, Edge edge);
  void hold_at(Edge edge, std::string event, bool before);
};

}  // namespace saltus
