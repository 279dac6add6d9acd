// Controls: leaves that are executed only while, or only when, a control signal says so.
#pragma once

#include <string>

#include "saltus/plan/detail/fixed_inputs.hpp"

namespace saltus::detail {

/// Gives each leaf of a controlled part one more input, after its own, that reads the control
/// signal, and other functions, which read this input: see DiagramBuilder::execute. Parts may be
/// nested; then a leaf gets one input for each of them.
void add_controls(Plan& plan, const Structure& structure, const LeafNumbers& numbers);

/// Throws ModelError, which begins with what was expected, unless a signal is one value that is held
/// between instants.
void require_one_held_value(const Plan& plan, int node, const std::string& expected);

/// Throws ModelError unless each control signal is one value that is held between instants, and for
/// an update with an inherited period outside of a triggered part.
void check_controls(const Plan& plan);

}  // namespace saltus::detail
