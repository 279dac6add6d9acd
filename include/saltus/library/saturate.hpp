// y = min(max(u, lower_limit), upper_limit), elementwise; either limit may be missing.
// in: any width. out: the width of u and the limits. Parameters "lower_limit", "upper_limit", those
// that are given. Where y reaches a derivative, the limits are located and the side is held between
// instants.
#pragma once

#include <optional>

#include "saltus/library/elementwise.hpp"

namespace saltus {

struct SaturateOptions {
  std::optional<Value> lower_limit = {};  ///< <= upper_limit
  std::optional<Value> upper_limit = {};
};

class Saturate final : public LeafSystem {
 public:
  using Options = SaturateOptions;

  Saturate(std::string name, const Options& options) : LeafSystem(std::move(name)) {
    const auto& [lower, upper] = options;
    detail::insist(lower || upper, this->name(), "no limit; give lower_limit, upper_limit or both");
    if (lower && upper) detail::require_ordered(this->name(), *lower, *upper);
    std::vector<Shape> limits;
    for (const auto& limit : {lower, upper}) {
      if (limit) limits.push_back(limit->shape());
    }
    declare_input_port({.name = "in"});
    const auto width = detail::relation_width(this->name(), limits);
    if (lower) {
      lower_ = declare_dynamic_parameter("lower_limit", lower->values);
      below_ = declare_relation(
          {.name = "below", .guard = &Saturate::shortfall, .size = width, .reads = Reads::inputs});
    }
    if (upper) {
      upper_ = declare_dynamic_parameter("upper_limit", upper->values);
      above_ = declare_relation(
          {.name = "above", .guard = &Saturate::excess, .size = width, .reads = Reads::inputs});
    }
    declare_output_port({.name = "out",
                         .calc = &Saturate::limited,
                         .shape = {},
                         .shape_rule = detail::stretch(this->name(), limits),
                         .reads = Reads::inputs | Reads::relations,
                         .entries = entry_by_entry});
  }

 private:
  void shortfall(const At& at, VectorRef g) const {
    const VectorView u = at.u[0], lower = at.parameter(lower_);
    for (Index i = 0; i < g.size(); ++i) g[i] = detail::entry(lower, i) - detail::entry(u, i);
  }
  void excess(const At& at, VectorRef g) const {
    const VectorView u = at.u[0], upper = at.parameter(upper_);
    for (Index i = 0; i < g.size(); ++i) g[i] = detail::entry(u, i) - detail::entry(upper, i);
  }
  void limited(const At& at, VectorRef out) const {
    const VectorView u = at.u[0];
    for (Index i = 0; i < out.size(); ++i) {
      if (below_.value >= 0 && at.relation(below_, i))
        out[i] = detail::entry(at.parameter(lower_), i);
      else if (above_.value >= 0 && at.relation(above_, i))
        out[i] = detail::entry(at.parameter(upper_), i);
      else
        out[i] = detail::entry(u, i);
    }
  }

  ParameterIndex lower_, upper_;
  RelationIndex below_, above_;  // -1: without that limit
};

}  // namespace saltus
