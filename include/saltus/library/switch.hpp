// y = true_value if control is true, otherwise false_value; elementwise.
// true_value, false_value: scalars and vectors of one width. control: one boolean, true if not 0;
// with a threshold one real number, true if control >= threshold, located and held if y reaches a
// derivative. A real signal that changes continuously needs the threshold: without it the solver
// would see the jump.
#pragma once

#include <optional>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

struct SwitchOptions {
  std::optional<double> threshold = {};  ///< in the unit of control; parameter "threshold" if given
};

class Switch final : public LeafSystem {
 public:
  using Options = SwitchOptions;

  explicit Switch(std::string name, const Options& options = {});
};

}  // namespace saltus
