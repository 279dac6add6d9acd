// fuse: formulas of blocks that feed one another become one function.
#pragma once

#include "saltus/plan/plan.hpp"

namespace saltus::detail {

/// What a fused function sees as `At` is all of the machine: its x and p, its y as `z`, because a
/// tape comes to that quicker than to an input, and its z as input 0.
inline constexpr int input_of_z = 0;

/// Fills the walks of a plan that is complete otherwise; without formulas they stay empty. Linear
/// in blocks and wires. The numbers are those of the single calls to the last bit: each operation
/// of a formula is carried out as it stands there, and only equal ones are shared.
void fuse(Plan& plan);

}  // namespace saltus::detail
