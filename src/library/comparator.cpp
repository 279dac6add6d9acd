// y = u_0 operator u_1, elementwise, 0 or 1; operators <  <=  >  >=  ==  !=.
#include "saltus/library/comparator.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Comparator::Comparator(std::string name, std::string_view operation) : LeafSystem(std::move(name)) {
  detail::require_known(this->name(), "operator", operation, {"<", "<=", ">", ">=", "==", "!="});
  declare_input_port();
  declare_input_port();
  if (operation == "==" || operation == "!=") {
    equal_ = operation == "==";
    declare_truth(&Comparator::equality, Reads::inputs);
    return;
  }
  const double sign = operation[0] == '>' ? 1.0 : -1.0;
  relation_ =
      declare_relation({.name = "difference",
                        .true_at_zero = operation.size() == 2,
                        .size = std::nullopt,
                        .reads = Reads::inputs,
                        .formula = [sign](const auto& at) { return sign * (at.u(0) - at.u(1)); }});
  declare_truth(&Comparator::held_truth, Reads::relations);
}

void Comparator::declare_truth(VectorFunction calc, Reads reads) {
  declare_output_port({.name = "out",
                       .calc = std::move(calc),
                       .shape = {},
                       .shape_rule = detail::stretch(name()),
                       .reads = reads,
                       .boolean = true});
}

void Comparator::held_truth(const At& at, VectorRef out) const {
  for (Index i = 0; i < out.size(); ++i) out[i] = at.relation(relation_, i) ? 1.0 : 0.0;
}

void Comparator::equality(const At& at, VectorRef out) const {
  const VectorView a = at.u[0], b = at.u[1];
  for (Index i = 0; i < out.size(); ++i)
    out[i] = (detail::entry(a, i) == detail::entry(b, i)) == equal_ ? 1.0 : 0.0;
}

}  // namespace saltus
