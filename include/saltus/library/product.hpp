// y = 1 */ u_0 */ u_1 ..., elementwise, one operator an input: "*/" is u_0 / u_1, "/" is 1 / u_0.
// in_0, in_1, ...: scalars and vectors of one width. out: that width. A division by zero ends the
// run with an error.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Product final : public LeafSystem {
 public:
  explicit Product(std::string name, std::string_view operators = "**")
      : LeafSystem(std::move(name)), operators_(operators) {
    detail::require_count(this->name(), "operator", static_cast<int>(operators_.size()), 1);
    for (const char op : operators_) {
      detail::insist(
          op == '*' || op == '/', this->name(), "unknown operator '", std::string(1, op), "' in '",
          operators_,
          "'; expected one '*' or '/' for each input, as in \"*/\"; an Adder takes '+' and '-'");
      declare_input_port();
    }
    declare_output_port({.name = "out",
                         .calc = &Product::product,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name()),
                         .reads = Reads::inputs,
                         .entries = entry_by_entry});
  }

 private:
  void product(const At& at, VectorRef out) const {
    if (out.size() == 1) {  // most signals are scalars, and this is called in each step
      double product = 1.0;
      for (int k = 0; k < at.u.size(); ++k)
        product = operators_[static_cast<std::size_t>(k)] == '/' ? product / at.u(k)
                                                                  : product * at.u(k);
      out[0] = product;
      return;
    }
    out.setOnes();
    for (int k = 0; k < at.u.size(); ++k) {
      const VectorView u = at.u[k];
      const bool divide = operators_[static_cast<std::size_t>(k)] == '/';
      for (Index i = 0; i < out.size(); ++i) {
        const double factor = detail::entry(u, i);
        out[i] = divide ? out[i] / factor : out[i] * factor;
      }
    }
  }

  std::string operators_;
};

}  // namespace saltus
