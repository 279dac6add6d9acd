// y = function(u_0, u_1, ...), elementwise, 0 or 1; functions or, and, not, nor, nand, xor (an odd
#include "saltus/library/logical_operator.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

LogicalOperator::LogicalOperator(std::string name, const std::string& function, int n_inputs)
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

void LogicalOperator::truth(const At& at, VectorRef out) const {
  for (Index i = 0; i < out.size(); ++i) out[i] = truth_of(at.u, i) != negate_ ? 1.0 : 0.0;
}

bool LogicalOperator::truth_of(const Inputs& u, Index i) const {
  int count = 0;
  for (int k = 0; k < u.size(); ++k) count += detail::entry(u[k], i) != 0.0 ? 1 : 0;
  if (combine_ == Combine::odd) return count % 2 == 1;
  return combine_ == Combine::all ? count == u.size() : count > 0;
}

}  // namespace saltus
