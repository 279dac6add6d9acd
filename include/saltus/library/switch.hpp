// y = true_value if control is true, else false_value; elementwise.
// true_value, false_value: scalars and vectors of one width. control: one boolean, true where not
// 0; with a threshold one real number, true where control >= threshold, located and held where y
// reaches a derivative. A real signal that moves continuously needs the threshold: without it the
// solver would see the jump.
#pragma once

#include <optional>

#include "saltus/library/elementwise.hpp"

namespace saltus {

struct SwitchOptions {
  std::optional<double> threshold = {};  ///< in the unit of control; parameter "threshold" if given
};

class Switch final : public LeafSystem {
 public:
  using Options = SwitchOptions;

  explicit Switch(std::string name, const Options& options = {}) : LeafSystem(std::move(name)) {
    true_value_ = declare_input_port({.name = "true_value"});
    control_ = declare_input_port({.name = "control", .shape = Shape::scalar()});
    false_value_ = declare_input_port({.name = "false_value"});
    if (options.threshold) {
      threshold_ = declare_dynamic_parameter("threshold", *options.threshold);
      reached_ = declare_relation({.name = "reached",
                                   .guard = &Switch::margin,
                                   .true_at_zero = true,
                                   .reads = Reads::inputs,
                                   .inputs = std::vector{control_}});
    }
    declare_output_port(
        {.name = "out",
         .calc = &Switch::chosen,
         .shape = {},
         .shape_rule = detail::stretch(this->name()),
         .reads = options.threshold ? Reads::inputs | Reads::relations : Reads::inputs,
         .entries = entry_by_entry});
  }

 private:
  double margin(const At& at) const { return at.u(control_) - at.p[threshold_]; }

  void chosen(const At& at, VectorRef out) const {
    const bool truth = reached_.value >= 0 ? at.relation(reached_) : at.u(control_) != 0.0;
    const VectorView u = at.u[truth ? true_value_ : false_value_];
    for (Index i = 0; i < out.size(); ++i) out[i] = detail::entry(u, i);
  }

  int true_value_ = 0, control_ = 0, false_value_ = 0;
  ParameterIndex threshold_;
  RelationIndex reached_;  // -1: without threshold
};

}  // namespace saltus
