// y(t) = u(t - delay), and initial_output for t < t0 + delay, where t0 is the begin of the first
// run; in, out: the shape of initial_output. No feedthrough, so it may close a loop: x' = -x(t - 1).
//
// Between instants the input is kept as polynomials, within a tenth of the tolerance of the run.
// Each jump and each kink that an event makes in the input is a time event of the output, exactly
// `delay` later, and no step of the solver is longer than the delay (the method of steps: A. Bellen,
// M. Zennaro, "Numerical Methods for Delay Differential Equations", 2003, ch. 3). The past is part
// of the discrete state: a context that is saved and loaded has it.
#pragma once

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct TransportDelayOptions {
  Value initial_output = 0.0;
  int capacity = 256;  ///< pieces of the input within the delay
};

class TransportDelay final : public LeafSystem {
 public:
  using Options = TransportDelayOptions;

  /// delay > 0 [s]. Parameter: initial_output.
  TransportDelay(std::string name, double delay, const Options& options = {});

 private:
  void delayed(const At& at, VectorRef out) const;
  void pass_break(const At& at, Next& next) const;

  double delay_;  // [s]
  Index n_;       // width
  ParameterIndex initial_;
};

}  // namespace saltus
