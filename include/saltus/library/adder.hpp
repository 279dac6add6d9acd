// y = +-u_0 +- u_1 ..., elementwise, one sign an input: "+-" is u_0 - u_1.
// in_0, in_1, ...: scalars and vectors of one width. out: that width.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Adder final : public LeafSystem {
 public:
  explicit Adder(std::string name, std::string_view operators = "++")
      : LeafSystem(std::move(name)) {
    detail::require_count(this->name(), "operator", static_cast<int>(operators.size()), 1);
    for (const char sign : operators) {
      detail::insist(
          sign == '+' || sign == '-', this->name(), "unknown operator '", std::string(1, sign),
          "' in '", operators,
          "'; expected one '+' or '-' for each input, as in \"++-\"; a Product takes '*' and '/'");
      signs_.push_back(sign == '+' ? 1.0 : -1.0);
      declare_input_port();
    }
    declare_output_port({.name = "out",
                         .calc = &Adder::sum,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name()),
                         .reads = Reads::inputs,
                         .entries = entry_by_entry});
  }

 private:
  void sum(const At& at, VectorRef out) const {
    if (out.size() == 1) {  // most signals are scalars, and this is called in each step
      double sum = 0.0;
      for (int k = 0; k < at.u.size(); ++k) sum += signs_[static_cast<std::size_t>(k)] * at.u(k);
      out[0] = sum;
      return;
    }
    out.setZero();
    for (int k = 0; k < at.u.size(); ++k) {
      const VectorView u = at.u[k];
      const double sign = signs_[static_cast<std::size_t>(k)];
      for (Index i = 0; i < out.size(); ++i) out[i] += sign * detail::entry(u, i);
    }
  }

  std::vector<double> signs_;
};

}  // namespace saltus
