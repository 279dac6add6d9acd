// Comparisons that stand exactly at their root when a run starts: they take the side the flow takes
// them to. x goes from 0 with +1 or -1, and y' = 1 while x is above, else -1.
#include "support/cases.hpp"

using namespace saltus;
using namespace support;

namespace {

enum class Told { greater, not_less, less, threshold, reduce, function };
constexpr std::array all_told{Told::greater,   Told::not_less, Told::less,
                              Told::threshold, Told::reduce,   Told::function};
const char* names[] = {"x > 0",       "x >= 0",       "0 < x", "Switch threshold",
                       "ReduceBlock", "FunctionBlock"};

Diagram above_zero(Told told, double rate, double start) {
  DiagramBuilder builder;
  auto& speed = builder.add<Constant>("speed", rate);
  auto& x = builder.add<Integrator>("x", Integrator::Options{.initial_state = start});
  auto& y = builder.add<Integrator>("y", Integrator::Options{});
  auto& zero = builder.add<Constant>("zero", 0.0);
  auto& plus = builder.add<Constant>("plus", 1.0);
  auto& minus = builder.add<Constant>("minus", -1.0);
  auto& choice = builder.add<Switch>(
      "choice", told == Told::threshold ? SwitchOptions{.threshold = 0.0} : SwitchOptions{});
  builder.connect(speed.output(), x.input());
  builder.connect(plus.output(), choice.input("true_value"));
  builder.connect(minus.output(), choice.input("false_value"));
  builder.connect(choice.output(), y.input());
  const auto compare = [&](const char* operation, const OutputPort& a, const OutputPort& b) {
    auto& block = builder.add<Comparator>("above", operation);
    builder.connect(a, block.input(0)), builder.connect(b, block.input(1));
    return block.output();
  };
  OutputPort above;
  switch (told) {
    case Told::greater:
      above = compare(">", x.output(), zero.output());
      break;
    case Told::not_less:
      above = compare(">=", x.output(), zero.output());
      break;
    case Told::less:
      above = compare("<", zero.output(), x.output());
      break;
    case Told::threshold:
      above = x.output();
      break;
    case Told::reduce: {
      auto& block = builder.add<ReduceBlock>("above", 1,
                                             [](std::span<const double> u) { return u[0] > 0.0; });
      builder.connect(x.output(), block.input(0));
      above = block.output();
      break;
    }
    case Told::function: {
      auto& block = builder.add<FunctionBlock>("above", [](double u) { return u > 0.0; });
      builder.connect(x.output(), block.input());
      above = block.output();
      break;
    }
  }
  builder.connect(above, choice.input("control"));
  return builder.build();
}

}  // namespace

TEST_CASE("a comparison at its root at the start takes the side the flow takes it to", "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double rate = GENERATE(1.0, -1.0, 1e-6, -1e6);
  const double start = GENERATE(0.0, -0.0);
  for (const Told told : all_told) {
    const Diagram diagram = above_zero(told, rate, start);
    const auto results =
        simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    // y = t or -t: nothing to integrate; an opaque boolean is seen to change after a rounding or
    // so, and lets that much of a second go the wrong way.
    INFO("rate " << rate << ", start " << start);
    within(text("at its root, ", names[static_cast<std::size_t>(told)]), method,
           std::abs(results.context.continuous_state()[1] - (rate > 0.0 ? 1.0 : -1.0)),
           400.0 * eps);
  }
}

TEST_CASE("a comparison that a run enters from its root's other side switches there once",
          "[laws]") {
  const auto method = GENERATE(from_range(methods));
  const double rate = GENERATE(1.0, -1.0);
  for (const Told told : all_told) {
    const Diagram diagram = above_zero(told, rate, -0.25 * rate);
    const auto results =
        simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
    within(text("through its root, ", names[static_cast<std::size_t>(told)]), method,
           std::abs(results.context.continuous_state()[1] - 0.5 * rate), 800.0 * eps);
    CHECK(firing_times(results.events).size() == 1);
  }
}
