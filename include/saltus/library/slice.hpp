// y = the chosen entries of u.
// in: a vector. out: a vector of the chosen entries, or a scalar if one index was given. The
// entries are a list of indices, or a range start, start + step, ... before stop. They are counted
// from 0, negative indices from the end, as in Python.
#pragma once

#include <optional>
#include <vector>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

/// The entries from `start` on, before `stop`, in steps of `step`; by default all.
struct SliceRange {
  std::optional<Index> start = {};
  std::optional<Index> stop = {};
  Index step = 1;  ///< not 0
};

class Slice final : public LeafSystem {
 public:
  using Range = SliceRange;

  Slice(std::string name, Index entry);
  Slice(std::string name, std::vector<Index> entries);
  Slice(std::string name, const Range& range);
};

}  // namespace saltus
