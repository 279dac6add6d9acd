// y = the value of a table at u, elementwise.
#include "saltus/library/lookup_table_1d.hpp"

#include <limits>

#include "saltus/library/detail/pieces.hpp"

namespace saltus {

LookupTable1d::LookupTable1d(std::string name, const Eigen::VectorXd& input_array,
                             const Eigen::VectorXd& output_array, const Options& options)
    : LeafSystem(std::move(name)) {
  detail::insist(input_array.size() == output_array.size(), this->name(), "input_array has ",
                 input_array.size(), " values, output_array has ", output_array.size(),
                 "; expected as many");
  const detail::Pieces pieces(this->name(), {input_array.begin(), input_array.end()},
                              options.interpolation, options.extrapolation);
  const ParameterIndex values = declare_dynamic_parameter("output_array", output_array);
  declare_input_port({.name = "in"});
  const RelationIndex even = declare_relation(
      {.name = "even_piece",
       .size = std::nullopt,
       .reads = Reads::inputs,
       .formula = [pieces](const auto& at) {
         const auto u = at.u(0);
         using Number = std::remove_cvref_t<decltype(u)>;
         return pieces.guard<Number>(u, [&at](const auto& c, const Number& a, const Number& b) {
           return at.choose(c, a, b);
         });
       }});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = elementwise,
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=](const auto& at) {
                         const auto u = at.u(0);
                         using Number = std::remove_cvref_t<decltype(u)>;
                         const auto choose = [&at](const auto& c, const Number& a,
                                                   const Number& b) { return at.choose(c, a, b); };
                         const auto point = [&](std::size_t i) {
                           return at.p(values, static_cast<Index>(i));
                         };
                         const Number y = pieces.value<Number>(u, at.relation(even), point, choose);
                         if (!pieces.bounded()) return y;
                         const Number none(std::numeric_limits<double>::quiet_NaN());
                         const Number above = choose(u >= pieces.first(), y, none);
                         return choose(u <= pieces.last(), above, none);
                       }});
}

}  // namespace saltus
