// y = function(u_0, u_1, ...), elementwise, 0 or 1; functions or, and, not, nor, nand, xor (an odd
// number is true). in_0, in_1, ...: booleans, true where not 0; scalars and vectors of one width.
// out: boolean, that width.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class LogicalOperator final : public LeafSystem {
 public:
  /// `not` has one input, the others `n_inputs`.
  explicit LogicalOperator(std::string name, const std::string& function, int n_inputs = 2);

 private:
  enum class Combine { any, all, odd };

  void truth(const At& at, VectorRef out) const;
  bool truth_of(const Inputs& u, Index i) const;

  Combine combine_ = Combine::any;
  bool negate_ = false;
};

}  // namespace saltus
