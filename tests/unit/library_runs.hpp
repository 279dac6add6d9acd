// What the tests of blocks in a run share: signals at chosen times, and the integral of an output.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "library_support.hpp"
#include "saltus/simulation/simulate.hpp"

namespace library_test {

/// Errors of the integrals: 10 (rtol |x| + atol) with |x| < 10 and rtol = 1e-10.
constexpr double solver_tolerance = 1e-8;

/// Where the integrand is piecewise linear or flat, a Runge-Kutta step is exact: what is left is
/// rounding, a few eps of |x| < 10 for each of at most 100 pieces.
constexpr double rounding = 1e-12;

inline saltus::SimulatorOptions precise() { return {.rtol = 1e-10, .atol = 1e-12}; }

/// Column `column` of a recorded signal at given times: after what happened there.
inline std::vector<double> at_times(const saltus::System& system, saltus::OutputPort port,
                                    const std::vector<double>& times, saltus::Index column = 0,
                                    saltus::SimulatorOptions options = precise()) {
  options.recorded_signals = {{"y", port}};
  options.save_at = times;
  options.save_steps = false;
  const auto results =
      saltus::simulate(system, system.create_context(), {0.0, times.back()}, options);
  const auto y = results.output("y");
  std::vector<double> values;
  for (const double t : times) {
    for (std::size_t row = results.time.size(); row-- > 0;) {
      if (results.time[row] != t) continue;
      values.push_back(y(static_cast<saltus::Index>(row), column));
      break;
    }
  }
  REQUIRE(values.size() == times.size());
  return values;
}

/// The integral of a block's output from 0 to t, its inputs being what `connect` makes of them.
template <class Block, class Connect, class... Arguments>
double integral(double t, Connect connect, Arguments&&... arguments) {
  saltus::DiagramBuilder builder;
  auto& block = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
  auto& sum = builder.add<saltus::Integrator>("sum");
  connect(builder, block);
  builder.connect(block.output(), sum.input());
  const saltus::Diagram diagram = builder.build();
  return at_times(diagram, sum.output(), {t}).back();
}

/// One block behind sources, in a diagram that can be run. `wire` adds the sources and connects
/// them.
template <class Block>
struct BlockRun {
  template <class Wire, class... Arguments>
  explicit BlockRun(Wire wire, Arguments&&... arguments)
      : diagram(build(block, wire, std::forward<Arguments>(arguments)...)) {}

  std::vector<double> at(const std::vector<double>& times, int port = 0) const {
    return at_times(diagram, block->output(port), times);
  }
  saltus::Results run(double end, saltus::SimulatorOptions options = precise()) const {
    return saltus::simulate(diagram, diagram.create_context(), {0.0, end}, options);
  }

  const Block* block = nullptr;
  saltus::Diagram diagram;

 private:
  template <class Wire, class... Arguments>
  static saltus::Diagram build(const Block*& block, Wire wire, Arguments&&... arguments) {
    saltus::DiagramBuilder builder;
    auto& added = builder.add<Block>("block", std::forward<Arguments>(arguments)...);
    block = &added;
    wire(builder, added);
    return builder.build();
  }
};

/// A source in front of the first input.
template <class Source, class... Arguments>
auto fed_by(Arguments... arguments) {
  return [=](saltus::DiagramBuilder& builder, auto& block) {
    builder.connect(builder.add<Source>("source", arguments...).output(), block.input());
  };
}

}  // namespace library_test
