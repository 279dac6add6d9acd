// y = +-u_0 +- u_1 ..., elementwise, with one sign for each input: "+-" is u_0 - u_1.
#include "saltus/library/adder.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Adder::Adder(std::string name, std::string_view operators) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "operator", static_cast<int>(operators.size()), 1);
  std::vector<double> signs;
  for (const char sign : operators) {
    detail::insist(
        sign == '+' || sign == '-', this->name(), "unknown operator '", std::string(1, sign),
        "' in '", operators,
        "'; expected one '+' or '-' for each input, as in \"++-\"; a Product takes '*' and '/'");
    signs.push_back(sign == '+' ? 1.0 : -1.0);
    declare_input_port();
  }
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [signs](const auto& at) {
                         auto sum = signs[0] * at.u(0);
                         for (std::size_t k = 1; k < signs.size(); ++k)
                           sum += signs[k] * at.u(static_cast<int>(k));
                         return sum;
                       }});
}

}  // namespace saltus
