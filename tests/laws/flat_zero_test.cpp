// Comparisons with zero of a signal that is exactly zero for a time, because a block before them says so.
#include <numbers>

#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A block whose output is positive for a quarter of the period of a sine, zero for a half, and negative
/// for a quarter: it becomes zero where |sin t| = sin(pi / 4).
template <class AddBlock>
double mean(const AddBlock& add, const std::string& operation, Method method) {
  using std::numbers::pi;
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine", SineOptions{.phase = 0.3});
  auto& block = add(builder);
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& compare = builder.add<Comparator>("compare", operation);
  auto& rate = builder.add<FunctionBlock>("rate", [](double truth) { return truth; });
  auto& x = builder.add<Integrator>("x", Integrator::Options{});
  builder.connect(sine.output(), block.input());
  builder.connect(block.output(), compare.input(0));
  builder.connect(zero.output(), compare.input(1));
  builder.connect(compare.output(), rate.input());
  builder.connect(rate.output(), x.input());
  const Diagram diagram = builder.build();
  const auto results =
      simulate(diagram, diagram.create_context(), {0.0, 4.0 * pi}, {.ode_solver_method = method});
  return results.context.continuous_state()[0] / (4.0 * pi);
}

}  // namespace

TEST_CASE("a comparison with zero is what it says while its signal is zero", "[laws][relations]") {
  const double edge = std::sin(std::numbers::pi / 4.0);
  const auto method = GENERATE(from_range(methods));
  const auto [operation, expected] =
      GENERATE(table<std::string, double>({{">", 0.25}, {">=", 0.75}, {"<", 0.25}, {"<=", 0.75}}));
  INFO("method " << method << ", operator " << operation);
  // The four edges of two periods are located within some roundings; the rate is constant in between.
  const double roundings = 1e-12;
  const auto dead = [&](DiagramBuilder& b) -> auto& {
    return b.add<DeadZone>("block", DeadZoneOptions{.half_range = edge});
  };
  const auto steps = [&](DiagramBuilder& b) -> auto& {
    return b.add<Quantizer>("block", 2.0 * edge);
  };
  CHECK(std::abs(mean(dead, operation, method) - expected) < roundings);
  CHECK(std::abs(mean(steps, operation, method) - expected) < roundings);
}
