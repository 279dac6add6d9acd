// Step sizes: the first, the next, the bounds, and stiffness seen where it is and not where it is
// not.
#include "saltus/solver/detail/step_size.hpp"
#include "support/leaves.hpp"

using namespace saltus;
using namespace support;

namespace {

Leaf van_der_pol(double mu) {
  return Leaf("van_der_pol", [=](Leaf& l) {
    l.declare_continuous_state(
        {.initial = vec({2.0, 0.0}), .ode = [=](const At& at, VectorRef xdot) {
           xdot << at.x[1], mu * (1.0 - at.x[0] * at.x[0]) * at.x[1] - at.x[0];
         }});
    l.declare_continuous_state_output("x");
  });
}

}  // namespace

TEST_CASE("auto sees that Van der Pol with mu = 1000 is stiff and hands over to BDF",
          "[step_size]") {
  const Leaf stiff = van_der_pol(1000.0);
  const auto results =
      simulate(stiff, stiff.create_context(), {0.0, 2000.0}, {.ode_solver_method = "auto"});
  CHECK(contains(results.statistics.method, "dopri5, then bdf"));
  CHECK(results.statistics.steps < 10000);  // dopri5 alone takes millions
  const auto bdf =
      simulate(stiff, stiff.create_context(), {0.0, 2000.0}, {.ode_solver_method = "bdf"});
  CHECK(std::abs(results.context.continuous_state()[0] - bdf.context.continuous_state()[0]) < 1e-2);
}

TEST_CASE("auto stays with dopri5 where nothing is stiff", "[step_size]") {
  const Leaf mild = van_der_pol(1.0);
  CHECK(simulate(mild, mild.create_context(), {0.0, 200.0}, {.ode_solver_method = "auto"})
            .statistics.method == "dopri5");
  const Leaf fast("fast", [](Leaf& l) {  // fast, but as fast as its solution
    l.declare_continuous_state(
        {.initial = vec({1.0, 0.0}),
         .ode = [](const At& at, VectorRef xdot) { xdot << 1e4 * at.x[1], -1e4 * at.x[0]; }});
  });
  CHECK(simulate(fast, fast.create_context(), {0.0, 0.1}, {.ode_solver_method = "auto"})
            .statistics.method == "dopri5");
}

TEST_CASE("no step is longer than max_minor_step_size", "[step_size]") {
  const auto* method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = van_der_pol(1.0);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 5.0},
                                {.ode_solver_method = method,
                                 .max_minor_step_size = 0.03,
                                 .recorded_signals = {{"x", leaf.output()}}});
  for (std::size_t i = 1; i < results.time.size(); ++i)
    CHECK(results.time[i] - results.time[i - 1] <= 0.03 + 5.0 * eps);  // of times up to 5 s
}

TEST_CASE("no instant is further off than max_major_step_length", "[step_size]") {
  const auto* method = GENERATE(from_range(methods));
  INFO("method " << method);
  const Leaf leaf = van_der_pol(1.0);
  const auto results = simulate(leaf, leaf.create_context(), {0.0, 5.0},
                                {.ode_solver_method = method, .max_major_step_length = 0.1});
  CHECK(results.statistics.instants >= 50);
  CHECK(results.events.empty());
}

TEST_CASE(
    "the controller lengthens by ten at most, shortens to a fifth at most, and never after a "
    "rejection",
    "[step_size]") {
  StepController controller(5.0);
  CHECK(controller.accept(1e-300, 1.0, false) <= 10.0);
  CHECK(StepController(5.0).accept(1.0, 1.0, false) >= 0.2);
  CHECK(StepController(5.0).accept(1e-300, 1.0, true) <= 1.0);
  CHECK(controller.reject(infinite, 1.0) == 0.1);
  CHECK(controller.reject(not_a_number, 1.0) == 0.1);
  CHECK(controller.reject(1e300, 1.0) == 1e-3);
  CHECK(controller.reject(1.0000001, 1.0) <= 0.9);
}
