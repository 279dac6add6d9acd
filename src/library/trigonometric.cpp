// y = function(u), elementwise, angles in rad.
#include "saltus/library/trigonometric.hpp"

#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/words.hpp"

namespace saltus {

namespace {

constexpr std::pair<std::string_view, tape::Op> trigonometric_functions[] = {
    {"sin", tape::Op::sin},     {"cos", tape::Op::cos},     {"tan", tape::Op::tan},
    {"asin", tape::Op::asin},   {"acos", tape::Op::acos},   {"atan", tape::Op::atan},
    {"sinh", tape::Op::sinh},   {"cosh", tape::Op::cosh},   {"tanh", tape::Op::tanh},
    {"asinh", tape::Op::asinh}, {"acosh", tape::Op::acosh}, {"atanh", tape::Op::atanh}};

}  // namespace

Trigonometric::Trigonometric(std::string name, std::string_view function)
    : LeafSystem(std::move(name)) {
  const tape::Op op = detail::meaning(this->name(), "function", function, trigonometric_functions);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [op](const auto& at) { return detail::operation(op, at.u(0)); }});
}

}  // namespace saltus
