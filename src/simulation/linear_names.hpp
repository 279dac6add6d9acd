// The names of the rows and columns of a linearisation.
#pragma once

#include <string>
#include <vector>

#include "saltus/plan/plan.hpp"

namespace saltus {

/// Adds "y", or "y[0]", "y[1]" for a vector, "y[0,0]", "y[0,1]" for a matrix.
void add_entries(std::vector<std::string>& names, const std::string& name, const Shape& shape);
/// "integrator.", or nothing where the system is one block.
std::string prefix_of(const Plan& plan, const PlanLeaf& leaf);
/// "integrator.x[0]", or the name that the block gave to the state.
std::vector<std::string> state_names(const Plan& plan);

}  // namespace saltus
