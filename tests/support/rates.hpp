// A diagram with signals of each rate.
#pragma once

#include "saltus/library/library.hpp"
#include "saltus/plan/compile.hpp"
#include "support/leaves.hpp"

namespace support {

/// A constant, a held and a continuous signal, each through a gain, and sums of them.
struct Rates {
  saltus::DiagramBuilder builder;
  saltus::Gain *constant, *held, *continuous;
  saltus::Adder *slow, *fast;
  std::unique_ptr<saltus::Diagram> diagram;

  Rates() {
    const auto chain = [&](auto& source, const char* name) {
      auto& gain = builder.add<saltus::Gain>(name, 2.0);
      builder.connect(source.output(), gain.input());
      return &gain;
    };
    constant = chain(builder.add<saltus::Constant>("one", 1.0), "constant");
    held = chain(builder.add<saltus::Step>("step"), "held");
    continuous = chain(builder.add<saltus::Sine>("sine"), "continuous");
    slow = &builder.add<saltus::Adder>("slow"), fast = &builder.add<saltus::Adder>("fast");
    builder.connect(constant->output(), slow->input(0)),
        builder.connect(held->output(), slow->input(1));
    builder.connect(slow->output(), fast->input(0)),
        builder.connect(continuous->output(), fast->input(1));
    diagram = std::make_unique<saltus::Diagram>(builder.build());
  }
};

}  // namespace support
