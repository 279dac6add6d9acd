// The passes of compile() over a plan that has its leaves, wires and recorded signals.
#pragma once

#include <memory>

#include "saltus/plan/detail/needs.hpp"

namespace saltus::detail {

/// The passes that may refuse a plan. They find the shape and the rate of every signal.
Roots find_shapes_and_rates(Plan& plan);

/// Gives each guard the signals behind it that may vary while it is constant: then they choose the
/// distance of the looks.
void add_reads_of_guards(Plan& plan);

/// Finds the guards that may turn within a step although the step suits the states: a guard that the time
/// itself moves, and a guard that a sine, a remainder or a floor of a state moves.
void find_guards_that_turn(Plan& plan);

/// The other passes: needs, guards, edges, schedule, fused formulas.
std::shared_ptr<const Plan> completed(Plan plan, const Roots& roots);

}  // namespace saltus::detail
