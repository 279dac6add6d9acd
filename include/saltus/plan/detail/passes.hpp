// The passes of compile() over a plan that has its leaves, wires and recorded signals.
#pragma once

#include <memory>

#include "saltus/plan/detail/needs.hpp"

namespace saltus::detail {

/// The passes that may refuse a plan. They find the shape and the rate of every signal.
Roots find_shapes_and_rates(Plan& plan);

/// The continuous signals among these nodes, and those from which they are computed, the nearest
/// first: a called function between them may be constant while what it reads varies.
std::vector<int> signals_behind(const Plan& plan, const std::vector<int>& nodes);

/// Gives each guard that is called the signals behind it: while it is constant, they choose the
/// distance of the looks. A formula says by itself how it varies.
void add_reads_of_guards(Plan& plan);

/// The other passes: needs, guards, edges, schedule, fused formulas.
std::shared_ptr<const Plan> completed(Plan plan, const Roots& roots);

}  // namespace saltus::detail
