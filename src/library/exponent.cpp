// y = e^u, or 2^u, elementwise.
#include "saltus/library/exponent.hpp"

#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/words.hpp"

namespace saltus {

namespace {

constexpr std::pair<std::string_view, tape::Op> exponent_bases[] = {{"exp", tape::Op::exp},
                                                                    {"2", tape::Op::exp2}};

}  // namespace

Exponent::Exponent(std::string name, std::string_view base) : LeafSystem(std::move(name)) {
  const tape::Op op = detail::meaning(this->name(), "base", base, exponent_bases);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [op](const auto& at) { return detail::operation(op, at.u(0)); }});
}

}  // namespace saltus
