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

/// Finds which guards follow the time itself: the steps of a method, which are chosen for the states,
/// say nothing of them.
void find_guards_that_follow_time(Plan& plan);

/// The other passes: needs, guards, edges, schedule, fused formulas.
std::shared_ptr<const Plan> completed(Plan plan, const Roots& roots);

}  // namespace saltus::detail
