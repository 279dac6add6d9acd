// y = min(max(u, lower_limit), upper_limit), elementwise; either limit may be missing.
#include "saltus/library/saturate.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

Saturate::Saturate(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const auto& [lower, upper] = options;
  detail::insist(lower || upper, this->name(), "no limit; give lower_limit, upper_limit or both");
  std::vector<Shape> limits;
  for (const auto& limit : {lower, upper}) {
    if (limit) limits.push_back(limit->shape());
  }
  declare_input_port({.name = "in"});
  const auto width = detail::relation_width(this->name(), limits);
  const Limit below = limit("lower_limit", lower, "below", width, -1.0);
  const Limit above = limit("upper_limit", upper, "above", width, 1.0);
  if (lower && upper) declare_parameter_check(detail::ordered(*below.value, *above.value));
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), limits),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [below, above](const auto& at) {
                         auto y = at.u(0);
                         for (const auto& [value, beyond] : {above, below}) {
                           if (value) y = at.choose(at.relation(beyond), at.p(*value), y);
                         }
                         return y;
                       }});
}

Saturate::Limit Saturate::limit(const char* parameter, const std::optional<Value>& value,
                                const char* relation, std::optional<Index> width, double outward) {
  if (!value) return {};
  const ParameterIndex k = declare_dynamic_parameter(parameter, value->values);
  const auto margin = [k, outward](const auto& at) { return outward * (at.u(0) - at.p(k)); };
  return {k, declare_relation(
                 {.name = relation, .size = width, .reads = Reads::inputs, .formula = margin})};
}

}  // namespace saltus
