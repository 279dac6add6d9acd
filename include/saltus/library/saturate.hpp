// y = min(max(u, lower_limit), upper_limit), elementwise; either limit may be missing.
// in: any width. out: the width of u and the limits. Parameters "lower_limit", "upper_limit", if
// given. If y reaches a derivative, the limits are located and the side is held between instants.
#pragma once

#include <optional>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct SaturateOptions {
  std::optional<Value> lower_limit = {};  ///< <= upper_limit
  std::optional<Value> upper_limit = {};
};

class Saturate final : public LeafSystem {
 public:
  using Options = SaturateOptions;

  Saturate(std::string name, const Options& options);

 private:
  /// The value of a limit, and whether u is beyond it.
  struct Limit {
    std::optional<ParameterIndex> value = {};
    RelationIndex beyond = {};
  };
  Limit limit(const char* parameter, const std::optional<Value>& value, const char* relation,
              std::optional<Index> width, double outward);
};

}  // namespace saltus
