// y = N (u - x), dx/dt = y, elementwise: the derivative of u behind a filter, s N / (s + N).
#include "saltus/library/derivative.hpp"

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

Derivative::Derivative(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const Value &coefficient = options.filter_coefficient, &initial = options.initial_state;
  detail::require_shape(this->name(), "filter_coefficient", coefficient.shape(), "initial_state",
                        initial.shape());
  const ParameterIndex k = declare_dynamic_parameter("filter_coefficient", coefficient.values);
  declare_parameter_check(detail::positive(k, "filter_coefficient", " 1/s",
                                           ", several times the fastest frequency of u"));
  declare_input_port({.name = "in", .shape = initial.shape()});
  const auto slope = [k](const auto& at) { return at.p(k) * (at.u(0) - at.x()); };
  declare_continuous_state({.initial = initial.values,
                            .reads = Reads::continuous_state | Reads::inputs,
                            .entries = entry_by_entry,
                            .formula = slope});
  declare_output_port({.name = "out",
                       .shape = initial.shape(),
                       .reads = Reads::continuous_state | Reads::inputs,
                       .entries = entry_by_entry,
                       .formula = slope});
}

}  // namespace saltus
