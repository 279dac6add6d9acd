// The parameters by which a system is linearised.
#pragma once

#include <memory>
#include <vector>

#include "saltus/model/context_entry.hpp"
#include "saltus/simulation/detail/computed_derivatives.hpp"
#include "saltus/simulation/linearize.hpp"

namespace saltus {

/// Their values, and how the parameters of all blocks change with them.
class LinearParameters {
 public:
  struct One {
    LinearInput input;
    ContextEntry entry;
    Index column = 0;  ///< of its first entry
  };

  explicit LinearParameters(std::shared_ptr<const ComputedParameters> computed = {})
      : computed_(std::move(computed)) {}

  void add(One one) { all_.push_back(std::move(one)); }
  /// Whether one of them has a value of this entry.
  bool has(const ContextEntry& entry) const;
  const std::vector<One>& all() const { return all_; }

  /// A context with the values that were given.
  Context written(Context context) const;
  /// At the values p of all parameters. Throws ModelError where there is no derivative.
  ParameterMoves moves(const Eigen::VectorXd& p);

  /// Writes the value that was given, if there is one.
  static void write(Context& context, const LinearInput& input, const ContextEntry& entry);

 private:
  ComputedDerivatives computed_;
  std::vector<One> all_;
};

}  // namespace saltus
