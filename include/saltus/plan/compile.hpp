// compile(system, taps): from a system to its plan.
#pragma once

#include <memory>

#include "saltus/plan/plan.hpp"

namespace saltus {

/// Compiles a system and the signals to record into a plan. Throws ModelError for an open input, an
/// algebraic loop (printed as the path it is), widths that do not fit, a recorded signal of another
/// system. The plan refers to the system, which has to live as long.
std::shared_ptr<const Plan> compile(const System& system, const RecordedSignals& recorded = {});

}  // namespace saltus
