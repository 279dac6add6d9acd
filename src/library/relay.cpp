// y = on_value after u has reached on_threshold, off_value after it has fallen to off_threshold.
#include "saltus/library/relay.hpp"

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

Relay::Relay(std::string name, const Options& options) : LeafSystem(std::move(name)) {
  const ParameterIndex on = declare_dynamic_parameter("on_threshold", options.on_threshold);
  const ParameterIndex high = declare_dynamic_parameter("on_value", options.on_value);
  const ParameterIndex low = declare_dynamic_parameter("off_value", options.off_value);
  declare_input_port({.name = "in", .shape = Shape::scalar()});
  if (options.on_threshold == options.off_threshold) {
    declare_comparison(on, high, low);  // one threshold, so it is one parameter
  } else {
    const ParameterIndex off = declare_dynamic_parameter("off_threshold", options.off_threshold);
    declare_parameter_check([=](const std::string& block, const ParameterValues& p) {
      detail::insist(p[off] < p[on], block, "off_threshold ", p[off], " is not below on_threshold ",
                     p[on],
                     "; expected off_threshold < on_threshold, or a Relay made with one "
                     "threshold");
    });
    declare_modes(options.initially_on, {on, off}, high, low);
  }
}

/// Two modes at one level would not chatter but leave it: the guard of the mode that is entered
/// is at zero and has just fired. A relation keeps the side that u has.
void Relay::declare_comparison(ParameterIndex threshold, ParameterIndex high, ParameterIndex low) {
  const RelationIndex reached = declare_relation(
      {.name = "on",
       .true_at_zero = true,
       .reads = Reads::inputs,
       .formula = [=](const auto& at, Index) { return at.u(0, 0) - at.p(threshold, 0); }});
  declare_output_port({.name = "out", .reads = Reads::relations, .formula = [=](const auto& at) {
                         return at.choose(at.relation(reached), at.p(high), at.p(low));
                       }});
}

void Relay::declare_modes(bool initially_on, const Thresholds& thresholds, ParameterIndex high,
                          ParameterIndex low) {
  declare_default_mode(initially_on ? 1 : 0);
  const auto turns = [this](const char* event, int from, double sign, ParameterIndex threshold) {
    declare_zero_crossing({.name = event,
                           .direction = Direction::negative_then_non_negative,
                           .start_mode = from,
                           .end_mode = 1 - from,
                           .at_start = AtStart::fire,
                           .zeno_tolerance = 0.0,  // a relay has no state that could rest
                           .formula = [=](const auto& at, Index) {
                             return sign * (at.u(0, 0) - at.p(threshold, 0));
                           }});
  };
  turns("turn_on", 0, 1.0, thresholds.on);
  turns("turn_off", 1, -1.0, thresholds.off);
  declare_output_port({.name = "out",
                       .calc = [=](const At& at) { return at.p[at.mode == 1 ? high : low]; },
                       .reads = Reads::mode});
}

}  // namespace saltus
