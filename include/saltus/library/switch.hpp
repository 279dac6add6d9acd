// y = true_value if control is true, otherwise false_value; elementwise.
// true_value, false_value: scalars and vectors of one width. control: one boolean, or one real number,
// true if not 0. Where the number moves through zero, y does not change; where it rests at zero, it is
// false meanwhile. With a threshold it is true if control >= threshold. Both are located and held if y
// reaches a derivative.
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
