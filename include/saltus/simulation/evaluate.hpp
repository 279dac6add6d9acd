// Evaluations: the values of a system at a context, without a run.
#pragma once

#include "saltus/plan/plan.hpp"

namespace saltus {

/// The right-hand side dx/dt = f(t, x, z, m, u, p) at the values of a context, one number for each
/// continuous state in the order of the context. No event happens: relations have the truths that
/// their guards have there, or that the run which ended there held, and states that rest have the
/// rate zero. Throws ModelError for a context of another system, and for a system that does not
/// compile, for example because of an open input.
Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context);

/// The same of one block or diagram in the system: one number for each of its own states.
Eigen::VectorXd evaluate_time_derivatives(const System& system, const Context& context,
                                          const System& part);

/// The present value of a signal.
struct SignalValue {
  Eigen::VectorXd values;
  Shape shape;  ///< a scalar, or a vector
};

/// The value of an output of the system, or of a block in it, at a context. Throws ModelError as
/// evaluate_time_derivatives does, and for a port of another system.
SignalValue evaluate_output(const System& system, OutputPort port, const Context& context);

/// The value that an input of the system, or of a block in it, has at a context: that of the
/// connected output, or its fixed value.
SignalValue evaluate_input(const System& system, InputPort port, const Context& context);

}  // namespace saltus
