// y = the smallest, or the largest, of u_0, u_1, ..., elementwise.
#include "saltus/library/min_max.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/words.hpp"

namespace saltus {

MinMax::MinMax(std::string name, std::string_view operation, int n_inputs)
    : LeafSystem(std::move(name)) {
  constexpr std::pair<std::string_view, double> signs[] = {{"min", -1.0}, {"max", 1.0}};
  const double sign = detail::meaning(this->name(), "operator", operation, signs);
  detail::require_count(this->name(), "input", n_inputs, 1);
  for (int k = 0; k < n_inputs; ++k) declare_input_port();
  std::vector<RelationIndex> takes;
  for (int k = 1; k < n_inputs; ++k) takes.push_back(beyond(k, sign));
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [takes](const auto& at) {
                         auto y = at.u(0);
                         for (std::size_t k = 0; k < takes.size(); ++k)
                           y = at.choose(at.relation(takes[k]), at.u(static_cast<int>(k) + 1), y);
                         return y;
                       }});
}

/// The guard has a kink where two inputs before k take over from each other. The kink is a root of
/// an earlier relation, so no step spans it.
RelationIndex MinMax::beyond(int k, double sign) {
  std::vector<int> inputs;
  for (int j = 0; j <= k; ++j) inputs.push_back(j);
  const tape::Op extreme = sign > 0.0 ? tape::Op::maximum : tape::Op::minimum;
  return declare_relation({.name = text("in_", k),
                           .size = std::nullopt,
                           .reads = Reads::inputs,
                           .inputs = inputs,
                           .formula = [=](const auto& at) {
                             auto best = at.u(0);
                             for (int j = 1; j < k; ++j)
                               best = detail::operation(extreme, best, at.u(j));
                             return sign * (at.u(k) - best);
                           }});
}

}  // namespace saltus
