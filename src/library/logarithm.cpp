// y = log(u), elementwise.
#include "saltus/library/logarithm.hpp"

#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/words.hpp"

namespace saltus {

namespace {

constexpr std::pair<std::string_view, tape::Op> logarithm_bases[] = {
    {"natural", tape::Op::log}, {"10", tape::Op::log10}, {"2", tape::Op::log2}};

}  // namespace

Logarithm::Logarithm(std::string name, std::string_view base) : LeafSystem(std::move(name)) {
  const tape::Op op = detail::meaning(this->name(), "base", base, logarithm_bases);
  declare_input_port({.name = "in"});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [op](const auto& at) { return detail::operation(op, at.u(0)); }});
}

}  // namespace saltus
