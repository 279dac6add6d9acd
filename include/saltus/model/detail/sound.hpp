// Whether values that come from outside are possible, and whether two layouts are of one structure.
#pragma once

#include <string>

#include "saltus/model/context.hpp"

namespace saltus::detail {

/// Throws ModelError for a layout whose leaves do not follow each other without gaps, or whose
/// systems lie outside its leaves. Nothing is allocated or read by its sizes before this check.
void require_sound(const Layout& layout);

/// Throws ModelError for a continuation that no run can have left: an impossible side, a truth that
/// is neither 0 nor 1, a number that is not finite, times that increase, a negative count.
void require_sound(const Continuation& continuation);

/// Throws ModelError for pending executions that no run of a system of this layout can have left:
/// of a block or a state that does not exist, due at no time, out of order, a negative count.
void require_sound(const PendingExecutions& pending, const Layout& layout);

/// The first difference between two lists of leaves, in words; empty if there is none. Leaves are
/// equal if they have the same path, the same numbers of states, and the same parameters. The path
/// of a single leaf counts only with `paths`, because the path of a block is its name alone, and is
/// longer in a diagram.
std::string difference(const Layout& expected, const Layout& found, bool paths = true);

}  // namespace saltus::detail
