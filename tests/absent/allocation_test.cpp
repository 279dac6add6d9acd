// Nothing is allocated in the loop when nothing is recorded: a long run asks for memory as often as
// a short one.
#include "support/allocations.hpp"
#include "support/balls.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

/// Allocations of the second of two advances; the first takes what is needed once.
long of_second_advance(const System& system, const Context& context, double first, double second,
                       SimulatorOptions options) {
  options.record_events = false;
  Simulator simulator(system, options);
  simulator.initialize(context);
  simulator.advance_to(first);
  return allocations_of([&] { simulator.advance_to(second); });
}

/// The second advance of a long run asks for no more than that of a short one.
void loop_is_free(const System& system, const Context& context, double first, double second,
                  double much_later, const SimulatorOptions& options) {
  const long few = of_second_advance(system, context, first, second, options);
  const long many = of_second_advance(system, context, first, much_later, options);
  CHECK(many == few);
}

}  // namespace

TEST_CASE("10000 steps allocate nothing", "[absent][allocation]") {
  const auto* method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf oscillator("oscillator", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << at.x[1], -at.x[0]; }});
  });
  loop_is_free(oscillator, oscillator.create_context(), 10.0, 20.0, 2000.0,
               {.ode_solver_method = method});
}

TEST_CASE("a stiff scene allocates nothing in its loop", "[absent][allocation]") {
  const Leaf decay("decay", [](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}), .ode = [](const At& at, VectorRef xdot) {
           xdot << -1e4 * (at.x[0] - std::cos(at.time)), at.x[0];
         }});
    l.declare_jacobian([](const At&, MatrixRef j) { j << -1e4, 0.0, 1.0, 0.0; });
  });
  loop_is_free(decay, decay.create_context(), 10.0, 20.0, 500.0, {.ode_solver_method = "bdf"});
}

TEST_CASE("a thousand bounces allocate nothing", "[absent][allocation]") {
  const auto* method = GENERATE(from_range(methods));
  for (const Scene& scene : all_forms({.e = 1.0})) {
    INFO(scene.form << ", method " << method);
    loop_is_free(*scene.system, scene.context(0.1, 0.0), 10.0, 12.0, 300.0,
                 {.ode_solver_method = method});
  }
}

TEST_CASE("changes of mode allocate nothing", "[absent][allocation]") {
  const auto* method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf thermostat("room", [](Leaf& l) {
    l.declare_continuous_state({.initial = vec({20.0}), .ode = [](const At& at) {
                                  return (at.mode == 1 ? 30.0 : 10.0) - at.x[0];
                                }});
    l.declare_jacobian([](const At&, MatrixRef j) { j(0, 0) = -1.0; });
    l.declare_default_mode(1);
    l.declare_zero_crossing({.name = "cold",
                             .guard = [](const At& at) { return at.x[0] - 19.0; },
                             .start_mode = 0,
                             .end_mode = 1});
    l.declare_zero_crossing({.name = "warm",
                             .guard = [](const At& at) { return at.x[0] - 21.0; },
                             .start_mode = 1,
                             .end_mode = 0});
  });
  loop_is_free(thermostat, thermostat.create_context(), 5.0, 6.0, 200.0,
               {.ode_solver_method = method});
}

TEST_CASE("ticks and monitors allocate nothing", "[absent][allocation]") {
  const auto* method = GENERATE("dopri5", "adams", "auto");
  INFO("method " << method);
  DiagramBuilder builder;
  auto& sine = builder.add<Sine>("sine");
  auto& hold = builder.add<ZeroOrderHold>("hold", 0.1);
  auto& integrator = builder.add<Integrator>("integrator");
  auto& above = builder.add<Leaf>("above", [](Leaf& l) {
    l.declare_input_port({.name = "in", .shape = Shape::scalar()});
    l.declare_zero_crossing({.name = "level", .guard = [](const At& at) { return at.u(0); }});
  });
  builder.connect(sine.output(), hold.input());
  builder.connect(hold.output(), integrator.input());
  builder.connect(integrator.output(), above.input());
  const Diagram diagram = builder.build();
  loop_is_free(diagram, diagram.create_context(), 50.0, 51.0, 150.0, {.ode_solver_method = method});
}
