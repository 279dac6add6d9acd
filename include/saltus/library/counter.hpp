// y = the number of edges of the trigger so far; with a limit it counts 0, 1, ..., limit - 1, 0, ...
// trigger: one boolean. out: scalar, a view of the discrete state. The edges are those of a held
// signal: a Comparator in front is located.
#pragma once

#include <optional>

#include "saltus/model/leaf_system.hpp"

namespace saltus {

struct CounterOptions {
  Edge edge = Edge::rising;
  std::optional<int> limit = {};  ///< > 0
  int initial_state = 0;
};

class Counter final : public LeafSystem {
 public:
  using Options = CounterOptions;

  explicit Counter(std::string name, const Options& options = {});
};

}  // namespace saltus
