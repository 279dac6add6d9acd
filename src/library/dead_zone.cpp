// y = 0 for |u| < half_range, elementwise; elsewhere y = u, or y = u -+ half_range with `shifted`.
#include "saltus/library/dead_zone.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

DeadZone::DeadZone(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("half_range", options.half_range.values);
  declare_parameter_check(detail::not_negative(k, "half_range"));
  const std::vector<Shape> shapes{options.half_range.shape()};
  declare_input_port({.name = "in"});
  const auto outside = [&](const char* relation, double sign) {
    return declare_relation(
        {.name = relation,
         .true_at_zero = true,
         .size = detail::relation_width(this->name(), shapes),
         .reads = Reads::inputs,
         .formula = [k, sign](const auto& at) { return sign * at.u(0) - at.p(k); }});
  };
  const RelationIndex above = outside("above", 1.0), below = outside("below", -1.0);
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), shapes),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=, shift = options.shifted ? 1.0 : 0.0](const auto& at) {
                         const auto u = at.u(0), edge = shift * at.p(k);
                         const auto low = at.choose(at.relation(below), u + edge, 0.0);
                         return at.choose(at.relation(above), u - edge, low);
                       }});
}

}  // namespace saltus
