// The part of a layout that belongs to one block or inner diagram.
#pragma once

#include <memory>
#include <utility>

#include "saltus/model/context.hpp"

namespace saltus::detail {

/// First entry and number of entries of the leaves of a range in one of the flat arrays, such as
/// &Layout::Leaf::x with &Layout::Leaf::nx.
std::pair<Index, Index> extent(const Layout& layout, const Layout::Range& range,
                               Index Layout::Leaf::*offset, Index Layout::Leaf::*size);

/// The layout of a part: the same leaves with offsets that start at zero.
std::shared_ptr<const Layout> part_layout(const Layout& whole, const Layout::Range& range);

}  // namespace saltus::detail
