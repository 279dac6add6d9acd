// compile(system, recorded) makes the plan of a system.
#pragma once

#include <memory>

#include "saltus/plan/refinement.hpp"

namespace saltus {

/// Compiles a system and the signals to record into a plan. Throws ModelError for an open input, an
/// algebraic loop (printed as its path of ports), widths that do not fit, and a recorded signal of
/// another system. The plan refers to the system, which must outlive it, but not to the refinement.
std::shared_ptr<const Plan> compile(const System& system, const RecordedSignals& recorded = {},
                                    Refinement* refinement = nullptr);

}  // namespace saltus
