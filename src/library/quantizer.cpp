// y = interval round(u / interval), elementwise: the nearest level, with a level at 0.
#include "saltus/library/quantizer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/operations.hpp"
#include "saltus/library/detail/parameter_checks.hpp"

namespace saltus {

Quantizer::Quantizer(std::string name, const Value& interval, const Options& options)
    : LeafSystem(std::move(name)) {
  const ParameterIndex k = declare_dynamic_parameter("interval", interval.values);
  declare_parameter_check(detail::positive(k, "interval"));
  detail::insist(options.hysteresis >= 0.0, this->name(), "hysteresis = ", options.hysteresis,
                 "; expected 0, or less than the interval");
  if (options.hysteresis > 0.0)
    declare_levels(interval, k, options.hysteresis);
  else
    declare_nearest(interval, k);
}

/// The level is a discrete state, 0 before the start: an input that begins beyond the bounds of
/// level 0 fires at once.
void Quantizer::declare_levels(const Value& interval, ParameterIndex k, double hysteresis) {
  const Shape shape = interval.shape();
  const ParameterIndex h = declare_dynamic_parameter("hysteresis", hysteresis);
  declare_parameter_check([=](const std::string& block, const ParameterValues& p) {
    for (const double step : p.vector(k))
      detail::insist(p[h] >= 0.0 && p[h] < step, block, "hysteresis = ", p[h],
                     "; expected 0, or less than the interval ", step);
  });
  declare_input_port({.name = "in", .shape = shape});
  declare_discrete_state(Eigen::VectorXd::Zero(shape.size));
  const auto moves = [&](const char* event, double sign) {
    const auto nearest = [k, sign](const At& at, Next& next) {
      Eigen::VectorXd levels = at.z;
      const double step = at.parameter(k)[at.entry], u = at.u[0][at.entry];
      const double found = step * std::rint(u / step);
      // at least one level on, whatever rounding says of an input at the bound
      const double on = levels[at.entry] + sign * step;
      levels[at.entry] = sign > 0.0 ? std::max(found, on) : std::min(found, on);
      next.set_discrete_state(levels);
    };
    declare_zero_crossing({.name = event,
                           .reset_map = nearest,
                           .direction = Direction::negative_then_non_negative,
                           .size = shape.size,
                           .at_start = AtStart::fire,
                           .zeno_tolerance = 0.0,  // a level has no state that could rest
                           .formula = [=](const auto& at, Index i) {
                             const auto bound = 0.5 * (at.p(k, i) + at.p(h, 0));
                             return sign * (at.u(0, i) - at.z(i)) - bound;
                           }});
  };
  moves("up", 1.0);
  moves("down", -1.0);
  declare_output_port({.name = "out",
                       .shape = shape,
                       .reads = Reads::discrete_state,
                       .view = Place{Space::z, 0, shape.size}});
}

/// The block holds whether the level is even, which takes one relation for any number of levels.
/// Its guard is smooth. y is the nearest level of the kind that is held, so a solver step that goes
/// too far, up to half an interval beyond the root, sees no jump.
void Quantizer::declare_nearest(const Value& interval, ParameterIndex k) {
  const std::vector<Shape> shapes{interval.shape()};
  declare_input_port({.name = "in"});
  const RelationIndex even = declare_relation({.name = "even",
                                               .size = detail::relation_width(this->name(), shapes),
                                               .reads = Reads::inputs,
                                               .formula = [k](const auto& at) {
                                                 using std::cos;
                                                 return cos(std::numbers::pi * (at.u(0) / at.p(k)));
                                               }});
  declare_output_port({.name = "out",
                       .shape = {},
                       .shape_rule = detail::stretch(this->name(), shapes),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry,
                       .formula = [=](const auto& at) {
                         const auto odd = 1.0 - at.relation(even);
                         const auto half = 0.5 * (at.u(0) / at.p(k) - odd);
                         const auto level = 2.0 * detail::operation(tape::Op::rint, half) + odd;
                         return at.p(k) * level;
                       }});
}

}  // namespace saltus
