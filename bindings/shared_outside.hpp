// Called functions that share values outside of the system: attributes, variables, lists.
#pragma once

#include <vector>

#include "saltus/model/leaf_system.hpp"

namespace saltus::python {

class PythonLeaf;

/// The functions of a block that read or write values which another called function writes or
/// reads, by their numbers.
struct SharedOutside {
  std::vector<int> readers = {}, writers = {};

  bool any() const { return !readers.empty() || !writers.empty(); }
  bool operator==(const SharedOutside&) const = default;
};

/// Says so in the declarations of the block: a reader is computed again after each instant in which
/// a writer ran, even if all that it reads of the system is constant.
void declare_shared(const PythonLeaf& leaf, const SharedOutside& shared, Declarations& declared);

}  // namespace saltus::python
