// y = u_0 operator u_1, elementwise, 0 or 1; operators <  <=  >  >=  ==  !=.
// in_0, in_1: scalars and vectors of one width. out: boolean, that width.
// The first four operators have a relation with the smooth guard u_0 - u_1, located and held if it
// reaches a derivative, a guard or a reset. Equality has no sign to change, so it is an opaque
// boolean, meant for held signals such as modes.
#pragma once

#include "saltus/library/elementwise.hpp"

namespace saltus {

class Comparator final : public LeafSystem {
 public:
  Comparator(std::string name, std::string_view operation) : LeafSystem(std::move(name)) {
    detail::require_known(this->name(), "operator", operation, {"<", "<=", ">", ">=", "==", "!="});
    declare_input_port();
    declare_input_port();
    if (operation == "==" || operation == "!=") {
      equal_ = operation == "==";
      declare_truth(&Comparator::equality, Reads::inputs);
      return;
    }
    const double sign = operation[0] == '>' ? 1.0 : -1.0;
    relation_ = declare_relation(
        {.name = "difference",
         .true_at_zero = operation.size() == 2,
         .size = std::nullopt,
         .reads = Reads::inputs,
         .formula = [sign](const auto& at) { return sign * (at.u(0) - at.u(1)); }});
    declare_truth(&Comparator::held_truth, Reads::relations);
  }

 private:
  void declare_truth(VectorFunction calc, Reads reads) {
    declare_output_port({.name = "out",
                         .calc = std::move(calc),
                         .shape = {},
                         .shape_rule = detail::stretch(name()),
                         .reads = reads,
                         .boolean = true});
  }
  void held_truth(const At& at, VectorRef out) const {
    for (Index i = 0; i < out.size(); ++i) out[i] = at.relation(relation_, i) ? 1.0 : 0.0;
  }
  void equality(const At& at, VectorRef out) const {
    const VectorView a = at.u[0], b = at.u[1];
    for (Index i = 0; i < out.size(); ++i)
      out[i] = (detail::entry(a, i) == detail::entry(b, i)) == equal_ ? 1.0 : 0.0;
  }

  bool equal_ = true;
  RelationIndex relation_;
};

}  // namespace saltus
