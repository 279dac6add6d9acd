// fuse: joins the formulas of blocks that feed one another into one function.
#pragma once

#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// The `At` of a fused function shows the whole machine: its x and p, its y as `z`, because a tape
/// reads z faster than an input, and its z as input 0.
inline constexpr int input_of_z = 0;

/// Fills the walks of a plan that is otherwise complete; without formulas they remain empty. The
/// time is linear in blocks and wires. The numbers are the numbers of the single calls, to the last
/// bit: each operation of a formula is kept, and only equal operations are shared.
void fuse(Plan& plan);

}  // namespace saltus::detail
