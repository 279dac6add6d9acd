// y = the entries of u in another shape, row by row.
// in: any shape of as many entries. out: the given shape.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Reshape final : public LeafSystem {
 public:
  /// ModelError for a shape without entries; ShapeMismatchError, when the diagram is built, if the
  /// input has another number of entries.
  Reshape(std::string name, Shape shape);
};

}  // namespace saltus
