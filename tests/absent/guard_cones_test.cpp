// A look at some guards computes the signals that these read, and no others.
#include "saltus/library/library.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// A state that falls from `start` at unit rate, behind a signal that counts its calls, behind a guard
/// with a reset map.
struct Chain {
  std::shared_ptr<int> calls = std::make_shared<int>(0);
  std::shared_ptr<Leaf> state, signal, guard;

  Chain(const std::string& name, double start, DiagramBuilder& builder)
      : state(std::make_shared<Leaf>("state_" + name,
                                     [=](Leaf& l) { declare_ramp(l, -1.0, start); })),
        signal(std::make_shared<Leaf>(
            "signal_" + name,
            [calls = calls](Leaf& l) {
              l.declare_input_port({.shape = Shape::scalar()});
              l.declare_output_port({.name = "out",
                                     .calc = [calls](const At& at) { return ++*calls, at.u(0); },
                                     .reads = Reads::inputs});
            })),
        guard(std::make_shared<Leaf>("guard_" + name, [](Leaf& l) {
          l.declare_input_port({.shape = Shape::scalar()});
          l.declare_discrete_state(vec({0.0}));
          l.declare_zero_crossing({.name = "zero",
                                   .guard = [](const At& at) { return at.u(0); },
                                   .reset_map = &count_up,
                                   .direction = Direction::positive_then_non_positive});
        })) {
    builder.add(state), builder.add(signal), builder.add(guard);
    builder.connect(state->output(), signal->input());
    builder.connect(signal->output(), guard->input());
  }
};

}  // namespace

TEST_CASE("the flow at a guard that fired is looked at by the signals of this guard", "[absent]") {
  const auto method = GENERATE(from_range(methods));
  INFO("method " << method);
  DiagramBuilder builder;
  const Chain falls("falls", 0.5, builder), stays("stays", 100.0, builder);
  const Diagram diagram = builder.build();
  const Results results =
      simulate(diagram, diagram.create_context(), {0.0, 1.0}, {.ode_solver_method = method});
  REQUIRE(results.events.size() == 1);
  CHECK(*stays.calls > 0);
  // After it has fired, the flow is asked for its side: at the present point, and a little later.
  CHECK(*falls.calls >= *stays.calls + 2);
}
