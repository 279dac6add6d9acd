// What the tests of event wires share: integrate-and-fire cells.
#pragma once

#include "saltus/model/diagram_builder.hpp"
#include "support/leaves.hpp"

namespace support {

/// v' = current - v from `start`; at v = 1 the event `fire` sets v to 0. Each delivery to `synapse`
/// adds its weight to v.
inline Leaf cell(const std::string& name, double current, double start = 0.0) {
  return Leaf(name, [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({start}), .ode = [current](const At& at) { return current - at.x[0]; }});
    l.declare_continuous_state_output("v");
    l.declare_zero_crossing(
        {.name = "fire",
         .guard = [](const At& at) { return at.x[0] - 1.0; },
         .reset_map = [](const At&, Next& next) { next.set_continuous_state({0.0}); },
         .direction = saltus::Direction::negative_then_non_negative});
    l.declare_event_input(
        {.name = "synapse", .reset_map = [](const At& at, saltus::Delivery& next) {
           next.set_continuous_state({at.x[0] + next.weight()});
         }});
  });
}

/// A leaf with the event `beat` at these times.
inline Leaf beats(const std::string& name, std::vector<double> times) {
  return Leaf(name, [=](Leaf& l) { l.declare_time_event({.name = "beat", .times = times}); });
}

/// z from 0: each delivery to `digit` makes 10 z + weight of it, so that z shows their order.
inline Leaf digits(const std::string& name) {
  return Leaf(name, [](Leaf& l) {
    l.declare_discrete_state(vec({0.0}));
    l.declare_discrete_state_output("z");
    l.declare_event_input({.name = "digit", .reset_map = [](const At& at, saltus::Delivery& next) {
                             next.set_discrete_state({10.0 * at.z[0] + next.weight()});
                           }});
  });
}

/// A diagram under construction.
struct Network {
  saltus::DiagramBuilder builder;
  std::map<std::string, std::shared_ptr<const saltus::System>> blocks = {};

  void add(Leaf leaf) {
    auto block = std::make_shared<Leaf>(std::move(leaf));
    blocks.emplace(block->name(), block);
    builder.add(block);
  }
  void wire(const std::string& from, std::string_view event, const std::string& to,
            std::string_view input, double weight = 1.0, double delay = 0.0) {
    builder.connect_event(blocks.at(from)->event_output(event), blocks.at(to)->event_input(input),
                          weight, delay);
  }
};

}  // namespace support
