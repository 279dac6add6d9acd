// y = u_k, where k is the whole number nearest to control, at least 0 and at most the last input;
#include "saltus/library/multiport_switch.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

MultiportSwitch::MultiportSwitch(std::string name, int n_inputs) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "input", n_inputs, 1);
  declare_input_port({.name = "control", .shape = Shape::scalar()});
  std::vector<RelationIndex> reached;  // entry k: control is at least k + 1/2
  for (int k = 0; k < n_inputs; ++k) declare_input_port({.name = text("in_", k)});
  for (int k = 0; k + 1 < n_inputs; ++k) {
    reached.push_back(declare_relation(
        {.name = text("in_", k + 1),
         .true_at_zero = true,
         .reads = Reads::inputs,
         .inputs = std::vector{0},
         .formula = [k](const auto& at, Index) { return at.u(0, 0) - (k + 0.5); }}));
  }
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [reached](const auto& at) {
                         auto y = at.u(1);
                         for (std::size_t k = 0; k < reached.size(); ++k)
                           y = at.choose(at.relation(reached[k], 0), at.u(static_cast<int>(k) + 2),
                                         y);
                         return y;
                       }});
}

}  // namespace saltus
