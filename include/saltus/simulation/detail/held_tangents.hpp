// The derivatives of the held signals, at the start of a run and at an instant.
#pragma once

#include "saltus/model/context.hpp"
#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// A run begins: the constant outputs follow the parameters, at fixed states.
void begin_signals(TangentProbe& probe, const Machine& machine, const Context& start,
                   TangentColumns& columns);

/// The machine has evaluated its signals at t [s]. The held ones, and the moving ones that reset maps
/// read, follow all that they read. Truths are held between instants, and their changes are events.
void follow_signals(TangentProbe& probe, const Machine& machine, double t, TangentColumns& columns);

}  // namespace saltus
