// y = 1 */ u_0 */ u_1 ..., elementwise, with one operator for each input: "*/" is u_0 / u_1, "/" is
#include "saltus/library/product.hpp"

#include "saltus/library/detail/elementwise.hpp"

namespace saltus {

Product::Product(std::string name, std::string_view operators) : LeafSystem(std::move(name)) {
  detail::require_count(this->name(), "operator", static_cast<int>(operators.size()), 1);
  for (const char op : operators) {
    detail::insist(
        op == '*' || op == '/', this->name(), "unknown operator '", std::string(1, op), "' in '",
        operators,
        "'; expected one '*' or '/' for each input, as in \"*/\"; an Adder takes '+' and '-'");
    declare_input_port();
  }
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = [all = std::string(operators)](const auto& at) {
                         auto product = all[0] == '/' ? 1.0 / at.u(0) : at.u(0);
                         for (std::size_t k = 1; k < all.size(); ++k) {
                           const auto factor = at.u(static_cast<int>(k));
                           product = all[k] == '/' ? product / factor : product * factor;
                         }
                         return product;
                       }});
}

}  // namespace saltus
