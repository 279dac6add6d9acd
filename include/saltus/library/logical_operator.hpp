// y = function(u_0, u_1, ...), elementwise, 0 or 1; functions or, and, not, nor, nand, xor (an odd
// number is true). in_0, in_1, ...: booleans, true where not 0; scalars and vectors of one width.
// out: boolean, that width.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class LogicalOperator final : public LeafSystem {
 public:
  /// `not` has one input, the others `n_inputs`.
  explicit LogicalOperator(std::string name, const std::string& function, int n_inputs = 2)
      : LeafSystem(std::move(name)) {
    detail::require_known(this->name(), "function", function,
                          {"or", "and", "not", "nor", "nand", "xor"});
    detail::require_count(this->name(), "input", n_inputs, 1);
    if (function == "not") n_inputs = 1;
    for (int k = 0; k < n_inputs; ++k) declare_input_port();
    combine_ = function == "and" || function == "nand" ? Combine::all
               : function == "xor"                     ? Combine::odd
                                                       : Combine::any;
    negate_ = function[0] == 'n';
    declare_output_port({.name = "out",
                         .calc = &LogicalOperator::truth,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name()),
                         .reads = Reads::inputs,
                         .boolean = true});
  }

 private:
  enum class Combine { any, all, odd };

  void truth(const At& at, VectorRef out) const {
    for (Index i = 0; i < out.size(); ++i) out[i] = truth_of(at.u, i) != negate_ ? 1.0 : 0.0;
  }
  bool truth_of(const Inputs& u, Index i) const {
    int count = 0;
    for (int k = 0; k < u.size(); ++k) count += detail::entry(u[k], i) != 0.0 ? 1 : 0;
    if (combine_ == Combine::odd) return count % 2 == 1;
    return combine_ == Combine::all ? count == u.size() : count > 0;
  }

  Combine combine_ = Combine::any;
  bool negate_ = false;
};

}  // namespace saltus
