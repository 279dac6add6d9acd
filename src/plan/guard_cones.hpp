// Guard cones: what each group of guards needs, of all that guards need.
#pragma once

#include "saltus/base/list.hpp"
#include "saltus/plan/detail/calls.hpp"

namespace saltus::detail {

/// The cone of each group of guards of the plan. A group whose guards or signals are fused with others
/// needs all, and so does one whose cone is too large to keep.
List<GuardCone> guard_cones(const Plan& plan);

}  // namespace saltus::detail
