// y = true_value if condition is true, otherwise false_value; elementwise.
#include "saltus/library/if_then_else.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/is_not_zero.hpp"

namespace saltus {

IfThenElse::IfThenElse(std::string name) : LeafSystem(std::move(name)) {
  const int condition = declare_input_port({.name = "condition", .shape = Shape::scalar()});
  const int yes = declare_input_port({.name = "true_value"});
  const int no = declare_input_port({.name = "false_value"});
  const RelationIndex yes_now = declare_relation(detail::is_not_zero(condition));
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=](const auto& at) {
                         return at.choose(at.relation(yes_now, 0), at.u(yes), at.u(no));
                       }});
}

}  // namespace saltus
