// The widths of options that have one number for each state.
#pragma once

#include "saltus/plan/plan.hpp"
#include "saltus/simulation/options.hpp"

namespace saltus {

/// Throws ModelError, with the blocks and their numbers of states, if a tolerance has another
/// number of entries than the plan has states.
void require_widths(const SimulatorOptions& options, const Plan& plan);

/// The tolerance of each of n states.
std::vector<double> each_of(const Tolerance& tolerance, Index n);

}  // namespace saltus
