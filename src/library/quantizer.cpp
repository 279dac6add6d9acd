// y = interval round(u / interval), elementwise: the nearest level, with a level at 0.
#include "saltus/library/quantizer.hpp"

#include <numbers>

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/operations.hpp"

namespace saltus {

/// The block holds whether the level is even, which takes one relation for any number of levels.
/// Its guard is smooth. y is the nearest level of the kind that is held, so a solver step that goes
/// too far, up to half an interval beyond the root, sees no jump.
Quantizer::Quantizer(std::string name, const Value& interval) : LeafSystem(std::move(name)) {
  for (const double step : interval.values) {
    detail::insist(step > 0.0, this->name(), "interval = ", step, "; expected a number > 0");
  }
  const ParameterIndex k = declare_dynamic_parameter("interval", interval.values);
  const std::vector<Shape> shapes{interval.shape()};
  declare_input_port({.name = "in"});
  const RelationIndex even = declare_relation({.name = "even",
                                               .size = detail::relation_width(this->name(), shapes),
                                               .reads = Reads::inputs,
                                               .formula = [k](const auto& at) {
                                                 using std::cos;
                                                 return cos(std::numbers::pi * (at.u(0) / at.p(k)));
                                               }});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), shapes),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=](const auto& at) {
                         const auto odd = 1.0 - at.relation(even);
                         const auto half = 0.5 * (at.u(0) / at.p(k) - odd);
                         const auto level = 2.0 * detail::operation(tape::Op::rint, half) + odd;
                         return at.p(k) * level;
                       }});
}

}  // namespace saltus
